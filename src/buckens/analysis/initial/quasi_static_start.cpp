// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/initial/quasi_static_start.h"

#include <algorithm>

#include <fmt/format.h>

#include "buckens/analysis/initial/acceleration.h"
#include "buckens/analysis/initial/position_assembly.h"
#include "buckens/base/errors.h"
#include "buckens/dynamics/constraints.h"
#include "buckens/dynamics/coupling_terms.h"
#include "buckens/dynamics/forces.h"

namespace buckens::analysis {

using linalg::Vector;

namespace {

constexpr int kMostRounds = 100;
// Of the largest displacement: joints are closed to 1e-12 of the model's length.
constexpr double kShapeSettled = 1e-10;

bool is_quasi_static(const body::Body& body) {
  return body.is_flexible() && body.flexible->is_quasi_static;
}

/// Deformation under the loads of the motion.
Vector deformation(const body::Body& body, const model::BodyState& s,
                   const Eigen::VectorXd& interface) {
  const body::FlexiblePart& part = *body.flexible;
  Vector load = part.rows.topRows(part.num_interface_rows).transpose() * interface;
  load +=
      part.invariants.centrifugal_patterns() * dynamics::centrifugal_weights(s.terms, s.frame.w);
  const model::Coupling coupling =
      dynamics::evaluate_coupling(body, s.terms, s.d, s.d_dot, s.d_ddot, s.frame.w, s.w_dot);
  if (coupling.load.size() > 0) load += coupling.load;
  return load.cwiseQuotient(part.fe.K.diagonal());
}

}  // namespace

void settle_accelerations(const model::Model& model, const dynamics::MassMetric& metric,
                          const std::vector<int>& rows_in_use, model::State& state,
                          const std::vector<char>& given) {
  compute_accelerations(model, metric, rows_in_use, state, given);
  if (std::none_of(model.bodies.begin(), model.bodies.end(), is_quasi_static)) return;
  std::size_t restless = 0;
  for (int round = 0; round < kMostRounds; ++round) {
    const auto motions = dynamics::motions_of(model, state);
    dynamics::Constraints constraints;
    dynamics::evaluate_constraints(model, motions, state.t, &state.memory, constraints);
    dynamics::Forces forces;
    dynamics::evaluate_forces(model, motions, state.t, dynamics::circumstances_of(state), forces);
    dynamics::add_joint_forces(constraints, state.lambda, forces);
    double change = 0;
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      if (!is_quasi_static(model.bodies[b])) continue;
      model::BodyState& s = state.bodies[b];
      const Vector before = s.d;
      s.d = deformation(model.bodies[b], s, forces.interface[b]);
      const double size = s.d.cwiseAbs().maxCoeff();
      const double moved = (s.d - before).cwiseAbs().maxCoeff();
      const double share = size > 0.0 ? moved / size : 0.0;
      if (!(share <= change)) restless = b;
      change = std::max(change, share);
    }
    assemble_positions(model, metric, state);
    project_velocities(model, metric, state);
    compute_accelerations(model, metric, rows_in_use, state, given);
    if (change <= kShapeSettled) return;
  }
  throw NumericalError(fmt::format(
      "the initial deformation of the quasi-static body \"{}\" does not converge: its loads change "
      "too much with its shape; stiffen it, or make it `flexibility: elastic`",
      model.bodies[restless].name));
}

}  // namespace buckens::analysis
