// SPDX-License-Identifier: Apache-2.0
// What ends a descent: balance to rounding, or a reason why there is none.
#include <cmath>

#include <fmt/format.h>

#include "buckens/analysis/statics/descent.h"
#include "buckens/analysis/statics/rest_pivots.h"
#include "buckens/analysis/statics/tolerances.h"
#include "buckens/base/errors.h"

namespace buckens::analysis {

using linalg::Vector;

namespace {

constexpr double kFarTurned = 40.0;  // rad
constexpr double kFarMoved = 20.0;   // model lengths

}  // namespace

void StaticDescent::polish() {
  sigma_ = kLeastInertia * reference_;
  for (int round = 0; round < 3; ++round) {
    const StaticPoint best = point_;
    const double before = misfit();
    system_->linearise(point_, balance_);
    Vector step;
    if (before == 0.0 || !solve_step(step)) return;
    // A step that is no longer small shows that the direction has no stiffness.
    if (motion_size(step) > kLongestStep) return;
    point_ = system_->moved(point_, step);
    evaluate();
    if (misfit() < 0.5 * before) continue;
    if (misfit() > before) {
      point_ = best;
      evaluate();
    }
    return;
  }
}

void StaticDescent::check_dependent_rows() {
  if (system_->rows_in_use().size() == static_cast<std::size_t>(model_.num_constraint_rows())) {
    return;
  }
  const Vector& g = balance_.constraints.g;
  Eigen::Index worst = 0;
  if (g.cwiseAbs().maxCoeff(&worst) <= kDependentGap * model_.length) return;
  if (row_choices_ < 4) {
    choose_rows();
    if (!is_balanced()) return;
  }
  const auto [joint, row] = model_.owner_of_row(static_cast<int>(worst));
  throw ModelError(fmt::format(
      "joint \"{}\" ({} between {} and {}) cannot be closed: {:.3g} {} are left in equilibrium, "
      "and no deformation would close them; correct the placement or remove a joint",
      joint->name, joints::to_string(joint->type), joint->first.text, joint->second.text,
      std::abs(g[worst]), joint->rows[static_cast<std::size_t>(row)].is_length() ? "m" : "rad"));
}

void StaticDescent::check_travel() const {
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const std::string& name = model_.bodies[b].name;
    const Eigen::Vector3d moved = point_.poses[b].p - start_.poses[b].p;
    if (!(moved.norm() <= kFarMoved * model_.length)) {
      refuse(fmt::format("body \"{}\" moves along {}", name, direction_text(moved)));
    }
    if (turned_[b].norm() > kFarTurned) {
      const Eigen::Vector3d axis = point_.poses[b].q * turned_[b];
      refuse(fmt::format("body \"{}\" turns about {}", name, direction_text(axis)));
    }
  }
}

void StaticDescent::refuse(const std::string& motion) const {
  throw ModelError(fmt::format(
      "no static equilibrium: under its loads {} and nothing holds it ({:.3g} N stay unbalanced); "
      "add a joint or a spring that carries this load, remove the load, {}or start `as-given`",
      motion, force_residual(),
      rest_.leaves_friction() ? "hold what rubs by `friction: frozen`, " : ""));
}

/// Rows that touch without a force hold nothing back.
RestStands StaticDescent::loaded_rows() const {
  RestStands out = point_.rest;
  rest_.open_unloaded(force_tolerance(), out);
  return out;
}

std::optional<StaticModes> StaticDescent::modes() {
  system_->linearise(point_, balance_);
  return static_modes(*system_, reference_, loaded_rows());
}

std::optional<StaticModes> StaticDescent::softest() {
  system_->linearise(point_, balance_);
  return softest_mode(*system_, reference_, loaded_rows());
}

}  // namespace buckens::analysis
