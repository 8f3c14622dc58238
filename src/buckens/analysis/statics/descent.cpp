// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/statics/descent.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "buckens/analysis/statics/rest_pivots.h"
#include "buckens/analysis/statics/state.h"
#include "buckens/analysis/statics/tolerances.h"
#include "buckens/base/errors.h"
#include "buckens/body/body_lengths.h"

namespace buckens::analysis {

using linalg::SparseMatrix;
using linalg::Vector;
using Share = StaticSystem::Share;
using Vector6 = Eigen::Matrix<double, 6, 1>;

namespace {

constexpr int kMaxDescentIterations = 400;
constexpr double kLongStep = 0.2;         // leaves the path of damped motion: more inertia
constexpr double kShortStep = 0.1;        // follows it well: less inertia
constexpr double kFarFromBalance = 1e-2;  // of the largest force: only there steps must go downhill
// Where faces end, as below a ball on the edge of a box, long steps may lead to and fro for ever.
// After so many without gain they are as short as of strongly damped motion, which does not.
constexpr int kLongWithoutGain = 30;
constexpr double kCalm = 10.0;  // of relevant σ
constexpr double kGain = 0.5;   // of the least unbalanced force
constexpr double kAway = 0.5;   // of the sum of all steps
// A force that moves no point by this fraction of the model's length is rounding: an unloaded path
// starts with multipliers of that size.
constexpr double kMovesNothing = 1e-18;

}  // namespace

StaticDescent::StaticDescent(const model::Model& model, const dynamics::MassMetric& metric,
                             RestRows& rest,
                             const std::vector<const ElasticCompliance*>& compliance, double t,
                             StaticPoint start)
    : model_(model),
      metric_(metric),
      rest_(rest),
      landings_(rest),
      compliance_(compliance),
      t_(t),
      point_(std::move(start)),
      start_(point_),
      turned_(model.bodies.size(), Eigen::Vector3d::Zero()) {
  set_scales();
  choose_rows();
  sigma_ = 10.0 * reference_;
}

void StaticDescent::set_scales() {
  const double L = model_.length;
  force_ = start_force_ = strongest_load(model_, rest_, point_, t_);
  double softest = 0.0;
  for (std::size_t b = 0; b < compliance_.size(); ++b) {
    if (compliance_[b] == nullptr || compliance_[b]->interface().size() == 0) continue;
    // Rotations by torques count as displacements by forces.
    const Eigen::VectorXd lengths = body::interface_lengths(model_.bodies[b], L);
    const Eigen::VectorXd answers = compliance_[b]->interface().diagonal();
    softest = std::max(softest, answers.cwiseProduct(lengths.cwiseAbs2()).maxCoeff());
  }
  no_force_ = softest > 0.0 ? kMovesNothing * L / softest : 0.0;
  if (force_ <= no_force_) force_ = softest > 0.0 ? 1e-3 * L / softest : 1.0;
  StaticSystem all(model_, rest_, compliance_, {}, t_, force_);
  const StaticBalance balance = all.balance(point_);
  double fastest = 0.0;
  double heaviest = 0.0;
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const body::Body& body = model_.bodies[b];
    const Vector6 a = dynamics::frame_mobility(body, body.J0) * balance.forces.frame[b];
    fastest = std::max({fastest, a.head<3>().norm(), a.tail<3>().norm() / L});
    heaviest = std::max(heaviest, body.mass);
  }
  reference_ = std::max(fastest, force_ / (std::max(heaviest, 1e-300) * L) * 1e-3);
  force_rounding_ = spring_rounding(model_, motions_at(model_, point_));
}

void StaticDescent::choose_rows() {
  if (++row_choices_ > 10) {
    throw NumericalError(
        "static equilibrium: the joints keep changing which of their equations are dependent (a "
        "dead centre); start from another position");
  }
  StaticSystem all(model_, rest_, compliance_, {}, t_, force_);
  const StaticBalance balance = all.balance(point_);
  const std::vector<int> rows = metric_.split(balance.constraints.rows).independent;
  for (int k = 0; k < model_.num_constraint_rows(); ++k) {
    if (!std::binary_search(rows.begin(), rows.end(), k)) point_.lambda[k] = 0.0;
  }
  system_.emplace(model_, rest_, compliance_, rows, t_, force_);
  lu_.reset();
  evaluate();
}

void StaticDescent::evaluate() {
  balance_ = system_->balance(point_);
  residual_ = system_->residual(point_, balance_);
  largest_force_ = std::max(start_force_, strongest_load(model_, rest_, point_, t_));
}

/// Gives rows to pairs that may meet on the way to a configuration; others `keep` theirs.
/// @return whether the equations are others now
bool StaticDescent::follow_pairs(const StaticPoint& to, bool keeps) {
  if (!rest_.follow_pairs(motions_towards(model_, point_, to), keeps)) return false;
  point_.rest = rest_.carried(point_.order, point_.rest);
  point_.order = rest_.order();
  const std::vector<int> rows = system_->rows_in_use();
  system_.emplace(model_, rest_, compliance_, rows, t_, force_);
  lu_.reset();
  evaluate();
  return true;
}

double StaticDescent::force_residual() const {
  return system_->force() * system_->largest(residual_, Share::frame);
}

double StaticDescent::misfit() const {
  return std::max({system_->largest(residual_, Share::frame),
                   system_->largest(residual_, Share::joint),
                   system_->largest(residual_, Share::elastic)});
}

double StaticDescent::force_tolerance() const {
  return kForceTolerance * largest_force_ + force_rounding_ + no_force_;
}

bool StaticDescent::is_balanced() const {
  return force_residual() <= force_tolerance() &&
         rest_.deepest(balance_.rest, point_.rest) <= closed_share(model_, point_) &&
         rest_.strongest_pull(point_.rest) <= force_tolerance() &&
         system_->largest(residual_, Share::joint) <= closed_share(model_, point_) &&
         system_->largest(residual_, Share::elastic) <=
             kForceTolerance * system_->largest_deformation(point_) + 1e-15;
}

void StaticDescent::run() {
  sigma_ = std::max(sigma_, 0.1 * reference_);
  bool has_shared = rest_.size() < 2;
  for (;;) {
    if (is_balanced()) {
      if (!has_shared) share_loads();
      has_shared = true;
      polish();
      check_dependent_rows();
      if (is_balanced()) return;
    }
    if (++iterations_ > kMaxDescentIterations + num_landings_) break;
    const Vector step = find_step();
    advance(step);
    // The next step is much like this one.
    follow_pairs(system_->moved(point_, step), false);
    check_travel();
  }
  Eigen::Index worst = 0;
  residual_.cwiseAbs().maxCoeff(&worst);
  const Vector where = Vector::Unit(residual_.size(), worst);
  throw NumericalError(fmt::format(
      "no static equilibrium found after {} iterations: an unbalanced force of {:.3g} N is left "
      "(largest force {:.3g} N), most of it where {}; start closer to the equilibrium, or let the "
      "motion settle by "
      "a simulation with dampers",
      kMaxDescentIterations, force_residual(), largest_force_,
      system_->share(static_cast<int>(worst)) == Share::frame
          ? describe_motion(model_, *system_, point_, where)
      : system_->share(static_cast<int>(worst)) == Share::joint
          ? system_->owner_at(static_cast<int>(worst)) + " does not close"
          : "bodies deform"));
}

bool StaticDescent::factorise(const SparseMatrix& tangent) {
  // Others of many bodies that touch have their entries elsewhere.
  const bool is_same_pattern = lu_ && model_.contact_groups.empty();
  if (is_same_pattern && lu_->factorise(tangent)) return true;
  lu_.emplace(tangent);  // again: pivots of another configuration may be bad here
  return lu_->factorise(tangent);
}

Vector StaticDescent::find_step() {
  system_->linearise(point_, balance_);
  for (int attempt = 0; attempt < 30; ++attempt) {
    Vector step;
    if (solve_step(step) && !leads_uphill(system_->tangent(sigma_, point_.rest), step)) {
      step *= std::min(1.0, kLongestStep / motion_size(step));
      if (!follow_pairs(system_->moved(point_, step), true)) return step;
      system_->linearise(point_, balance_);  // again, with the rows of those that it would meet
      --attempt;
      continue;
    }
    if (attempt == 15) {  // more inertia does not help: other rows may
      choose_rows();
      system_->linearise(point_, balance_);
      sigma_ = reference_;
    }
    sigma_ *= 4.0;
  }
  if (!lost_text_.empty()) throw NumericalError(lost_text_);
  throw NumericalError(
      "static equilibrium: the equations are singular whatever the inertia added (a dead centre of "
      "the joints); start from another position");
}

/// The step of the linear equations at the present σ, with the rows closed that are closed after
/// it.
bool StaticDescent::solve_step(Vector& step, double give) {
  const RestStands before = point_.rest;
  rest_.end_landings(point_.rest);
  rest_.follow_contacts(balance_.rest, point_.rest);
  do {
    if (!solve_with_pivots(step, give, before)) return false;
  } while (lands(step));
  return true;
}

/// Holds contacts that begin to press in a step. @return whether there are any more
bool StaticDescent::lands(const Vector& step) {
  const double share = std::min(1.0, kLongestStep / motion_size(step));
  return landings_.hold(balance_.rest, motions_at(model_, system_->moved(point_, share * step)), t_,
                        point_.rest);
}

/// @param before stands to return to if rows do not settle
bool StaticDescent::solve_with_pivots(Vector& step, double give, const RestStands& before) {
  RestPivots pivots(*system_);
  for (auto outcome = RestPivots::Outcome::moved; outcome != RestPivots::Outcome::settled;) {
    residual_ = system_->residual(point_, balance_);
    step = -residual_;
    if (!factorise(system_->tangent(sigma_, point_.rest, give))) return false;
    lu_->solve_in_place(step);
    if (!step.allFinite()) return false;
    outcome = pivots.revise(balance_, step, point_);
    if (outcome != RestPivots::Outcome::lost) continue;
    lost_text_ = pivots.lost_text();
    point_.rest = before;
    residual_ = system_->residual(point_, balance_);
    return false;
  }
  lost_text_.clear();
  return true;
}

/// Finds the forces of rows anew, in place.
void StaticDescent::share_loads() {
  const StaticPoint before = point_;
  rest_.share(balance_.rest, point_.rest);
  evaluate();
  system_->linearise(point_, balance_);
  Vector step;
  if (solve_step(step, StaticSystem::kGiveOfSharing)) {
    point_ = system_->moved(point_, system_->forces_of(step));
  } else {
    point_ = before;
  }
  evaluate();
}

bool StaticDescent::leads_uphill(const SparseMatrix& tangent, const Vector& step) const {
  // Near a saddle Newton's method may end there; the direction onwards is then known exactly.
  if (force_residual() < kFarFromBalance * largest_force_) return false;
  // Work of the step on the tangent, with the multipliers' part as if joints were closed.
  double whole = 0.0;
  Vector frame_only = step;
  for (int k = 0; k < system_->size(); ++k) {
    if (system_->share(k) == Share::frame) whole -= residual_[k] * step[k];
    if (system_->share(k) == Share::joint) whole -= residual_[k] * step[k];
    if (system_->share(k) != Share::frame) frame_only[k] = 0.0;
  }
  return whole < 0.0 && frame_only.dot(tangent * frame_only) < 0.0;
}

double StaticDescent::motion_size(const Vector& step) const {
  double size = 0.0;
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const Vector6 u = system_->frame_step(b, step);
    size = std::max({size, u.head<3>().norm(), u.tail<3>().norm() / model_.length});
  }
  return size;
}

void StaticDescent::advance(const Vector& step) {
  const StaticPoint from = point_;
  const double before = system_->largest(residual_, Share::frame);
  double factor = 1.0;
  for (int halving = 0;; ++halving, factor *= 0.5) {
    point_ = system_->moved(from, factor * step);
    try {
      evaluate();
      break;
    } catch (const NumericalError&) {
      if (halving == 8) throw;  // a force law that cannot be evaluated anywhere near
    }
  }
  const auto way = [&](double share) {
    return motions_at(model_, system_->moved(from, share * factor * step));
  };
  const std::optional<double> landing = landings_.find(way, t_);
  if (landing) {
    factor *= *landing;
    point_ = system_->moved(from, factor * step);
    evaluate();
    ++num_landings_;
  }
  for (std::size_t b = 0; b < turned_.size(); ++b) {
    turned_[b] += factor * system_->frame_step(b, step).head<3>();
  }
  if (landing) return;  // the step as such was neither too long nor too short
  const double after = system_->largest(residual_, Share::frame);
  const double size = motion_size(factor * step);
  if (size > kLongStep) {
    sigma_ *= 2.0;
  } else if (size < kShortStep || after <= 0.5 * before) {
    sigma_ *= after <= 0.5 * before ? 0.1 : 0.3;
  }
  const bool is_calm = goes_to_and_fro(after, size);
  sigma_ = std::max(sigma_, (is_calm ? kCalm : kLeastInertia) * reference_);
}

/// Whether many steps have led to no smaller force, nor far from where there was the smallest.
/// @param residual unbalanced force after a step, scaled, @param size of the step
bool StaticDescent::goes_to_and_fro(double residual, double size) {
  if (residual <= kGain * least_residual_) {
    least_residual_ = residual;
    without_gain_ = 0;
    way_without_gain_ = 0.0;
    best_ = point_.poses;
    best_turned_ = turned_;
  }
  way_without_gain_ += size;
  if (++without_gain_ <= kLongWithoutGain) return false;
  double away = 0.0;
  for (std::size_t b = 0; b < best_.size(); ++b) {
    const double turned = (turned_[b] - best_turned_[b]).norm();  // more turns are further
    away = std::max({away, turned, (point_.poses[b].p - best_[b].p).norm() / model_.length});
  }
  return away < kAway * way_without_gain_;
}

void StaticDescent::push(const Vector& shape, double amount, double stiffness) {
  Vector step = shape * (amount / motion_size(shape));
  // Rather away from what touches.
  double deepest = 0.0;
  for (std::size_t k = 0; k < rest_.size(); ++k) {
    if (!rest_.touches(k, balance_.rest)) continue;
    const double gap = balance_.rest.contacts[k].sign * system_->gap_change(k, step);
    if (std::abs(gap) > std::abs(deepest)) deepest = gap;
  }
  if (deepest < 0.0) step = -step;
  for (int k = 0; k < system_->size(); ++k) {
    if (system_->share(k) == Share::joint) step[k] = 0.0;
  }
  const StaticPoint pushed = system_->moved(point_, step);
  follow_pairs(pushed, true);
  point_.poses = pushed.poses;
  point_.y = pushed.y;
  sigma_ = std::max(reference_, 2.0 * std::abs(stiffness));
  evaluate();
}

}  // namespace buckens::analysis
