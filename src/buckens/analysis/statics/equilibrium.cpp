// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/statics/equilibrium.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "buckens/analysis/statics/descent.h"
#include "buckens/analysis/statics/friction_demand.h"
#include "buckens/analysis/statics/stability.h"
#include "buckens/analysis/statics/state.h"
#include "buckens/base/errors.h"

namespace buckens::analysis {

using linalg::Vector;

namespace {

constexpr int kMostPushes = 8;
constexpr double kPush = 0.1;  // rad, or of the model's length

void note_laws_of_time(const model::Model& model, double t, std::vector<std::string>& notes) {
  for (const model::Load& load : model.loads) {
    if (load.element->is_constant()) continue;
    notes.push_back(fmt::format(
        "load \"{}\" varies with time; the equilibrium is that of its value at t = {:.6g} s",
        load.name, t));
  }
  for (const model::Joint& joint : model.joints) {
    const bool driven =
        std::any_of(joint.rows.begin(), joint.rows.end(),
                    [](const joints::ConstraintRow& row) { return row.depends_on_time(); });
    if (!driven) continue;
    notes.push_back(fmt::format(
        "joint \"{}\" is driven; the equilibrium is that of its position at t = {:.6g} s, at rest",
        joint.name, t));
  }
}

void note_large_rotations(const model::Model& model, const model::State& state,
                          std::vector<std::string>& notes) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const double largest = largest_nodal_rotation(model.bodies[b], state.bodies[b].d);
    if (largest <= kLargestNodalRotation) continue;
    notes.push_back(
        fmt::format("body \"{}\" is bent by {:.3g} rad in its equilibrium; linear elasticity is "
                    "valid up to about {} rad: give it more `frames` or stiffen it",
                    model.bodies[b].name, largest, kLargestNodalRotation));
  }
}

void note_unloaded(const RestRows& rest, const StaticDescent& descent,
                   std::vector<std::string>& notes) {
  const std::string names =
      rest.unloaded(descent.balance().rest, descent.point().rest, descent.force_tolerance());
  if (names.empty()) return;
  notes.push_back(
      fmt::format("loads {} touch without pressing; stability and small vibrations are those "
                  "without them",
                  names));
}

/// Those without restoring force: any combination of them is as good as the first.
linalg::Matrix free_motions(const StaticModes& modes) {
  Eigen::Index count = 0;
  while (count < modes.stiffness.size() && modes.stiffness[count] <= modes.tolerance) ++count;
  return modes.shapes.leftCols(std::max<Eigen::Index>(count, 1));
}

}  // namespace

void settle_statically(const model::Model& model, StaticDescent& descent, StaticReport& report) {
  for (int push = 0;; ++push) {
    descent.run();
    const auto modes = descent.modes();
    if (!modes || modes->stiffness.size() == 0) return;
    report.lowest_stiffness = modes->stiffness[0];
    const std::string motion =
        describe_motion(model, descent.system(), descent.point(), modes->shapes.col(0));
    if (modes->stiffness[0] > modes->tolerance) return;
    if (modes->stiffness[0] >= -modes->tolerance) {
      report.lowest_stiffness = 0.0;
      report.notes.push_back(
          "the equilibrium is not unique: " +
          describe_motions(model, descent.system(), descent.point(), free_motions(*modes)) +
          " without any restoring force; it stays near its start");
      return;
    }
    if (push == kMostPushes) {
      report.notes.push_back("the equilibrium is not stable: " + motion);
      return;
    }
    descent.push(modes->shapes.col(0), kPush, modes->stiffness[0]);
  }
}

StaticReport find_static_equilibrium(const model::Model& model, const dynamics::MassMetric& metric,
                                     model::State& state, model::RestFriction friction,
                                     model::RigidPairs* groups) {
  StaticReport report;
  const Compliances compliances(model);
  report.factorisations = static_cast<int>(compliances.owned.size());
  note_laws_of_time(model, state.t, report.notes);
  RestRows rest(model, friction, state, groups);
  StaticDescent descent(model, metric, rest, compliances.of_body, state.t,
                        static_point(model, rest, state));
  report.warnings = rest.overlaps(descent.balance().rest);
  settle_statically(model, descent, report);
  const StaticPoint& point = descent.point();
  const StaticBalance balance = descent.system().balance(point);
  set_static_state(point, rest, balance, compliances, state);
  report.rest = point.rest;
  report.order = point.order;
  report.held = rest.held_contacts(balance.rest, point.rest);
  note_unloaded(rest, descent, report.notes);
  for (std::string& text :
       overloaded_friction(friction_demands(model, metric, rest, point.rest, state))) {
    report.warnings.push_back(std::move(text));
  }
  for (const auto& compliance : compliances.owned) report.solves += compliance->num_solves();
  note_large_rotations(model, state, report.notes);
  report.iterations = descent.iterations();
  report.force_residual = descent.force_residual();
  report.largest_force = descent.largest_force();
  report.force_tolerance = descent.force_tolerance();
  report.position_residual =
      point.lambda.size() > 0 ? balance.constraints.g.cwiseAbs().maxCoeff() : 0.0;
  return report;
}

StaticReport find_static_equilibrium(const model::Model& model, model::State& state,
                                     model::RestFriction friction) {
  return find_static_equilibrium(model, dynamics::MassMetric(model), state, friction);
}

}  // namespace buckens::analysis
