// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/initial/quasi_static_start.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "buckens/analysis/initial/acceleration.h"
#include "buckens/analysis/initial/mixed_rounds.h"
#include "buckens/analysis/initial/position_assembly.h"
#include "buckens/base/errors.h"
#include "buckens/body/body_lengths.h"
#include "buckens/dynamics/constraints.h"
#include "buckens/dynamics/coupling_terms.h"
#include "buckens/dynamics/forces.h"
#include "buckens/dynamics/travel.h"
#include "buckens/loads/coordinate_motor.h"

namespace buckens::analysis {

using linalg::Vector;

namespace {

constexpr int kMostRounds = 100;
// Of the largest displacement: joints are closed to 1e-12 of the model's length.
constexpr double kShapeSettled = 1e-10;
// Of the model's length: such changes of shape are rounding, also where hardly any load is left.
constexpr double kNoChange = 1e-16;
// A motor is torn from its speed by this share of it, if it shows within a step [m] or [rad].
constexpr double kTorn = 1e-3;
constexpr double kVisible = 1e-9;

bool is_quasi_static(const body::Body& body) {
  return body.is_flexible() && body.flexible->is_quasi_static;
}

/// Deformation under the loads of the motion.
Vector deformation(const body::Body& body, const model::BodyState& s,
                   const Eigen::VectorXd& interface) {
  const body::FlexiblePart& part = *body.flexible;
  Vector load = part.rows.topRows(part.num_interface_rows).transpose() * interface;
  part.invariants.add_centrifugal_load(dynamics::centrifugal_weights(s.terms, s.frame.w), load);
  const model::Coupling coupling =
      dynamics::evaluate_coupling(body, s.terms, s.d, s.d_dot, s.d_ddot, s.frame.w, s.w_dot);
  if (coupling.load.size() > 0) load += coupling.load.whole();
  return load.cwiseQuotient(part.fe.K.diagonal());
}

/// Shapes of all quasi-static bodies as displacements. @param lengths of their coordinates, else
/// empty
Vector gather(const std::vector<Vector>& lengths, const model::State& state) {
  Eigen::Index size = 0;
  for (const Vector& own : lengths) size += own.size();
  Vector out(size);
  Eigen::Index at = 0;
  for (std::size_t b = 0; b < lengths.size(); ++b) {
    if (lengths[b].size() == 0) continue;
    out.segment(at, lengths[b].size()) = state.bodies[b].d.whole().cwiseProduct(lengths[b]);
    at += lengths[b].size();
  }
  return out;
}

void scatter(const Vector& all, const std::vector<Vector>& lengths, model::State& state) {
  Eigen::Index at = 0;
  for (std::size_t b = 0; b < lengths.size(); ++b) {
    if (lengths[b].size() == 0) continue;
    state.bodies[b].d = all.segment(at, lengths[b].size()).cwiseQuotient(lengths[b]);
    at += lengths[b].size();
  }
}

/// Rigid stops and the like that hold, quoted.
std::string holding_rows(const model::Model& model, const model::State& state) {
  std::string out;
  for (const model::Load& load : model.loads) {
    if (load.rigid_row < 0 || state.memory.laws[load.first_state] == 0.0) continue;
    out += fmt::format("{}\"{}\"", out.empty() ? " while it holds " : ", ", load.name);
  }
  return out;
}

/// @param body the quasi-static one that deforms most
[[noreturn]] void refuse(const model::Model& model, const model::State& state,
                         const std::string& body) {
  if (state.last_step > 0.0) {
    throw NumericalError(fmt::format(
        "at t = {:.6g} s, after a change of what holds the bodies, the deformation of the "
        "quasi-static body \"{}\" does not settle{}: its loads change too much with its shape; "
        "give what it runs against a `stiffness`, stiffen it, or make it `flexibility: elastic`",
        state.t, body, holding_rows(model, state)));
  }
  throw NumericalError(fmt::format(
      "the initial deformation of the quasi-static body \"{}\" does not converge: its loads change "
      "too much with its shape; stiffen it, or make it `flexibility: elastic`",
      body));
}

/// Within a run, bodies that cannot be put together are no fault of the model's placement.
void close_positions(const model::Model& model, const dynamics::MassMetric& metric,
                     model::State& state, const std::string& body) try {
  assemble_positions(model, metric, state);
} catch (const ModelError&) {
  if (!(state.last_step > 0.0)) throw;
  refuse(model, state, body);
}

}  // namespace

bool has_quasi_static_bodies(const model::Model& model) {
  return std::any_of(model.bodies.begin(), model.bodies.end(), is_quasi_static);
}

void let_go_of_torn_motors(const model::Model& model, model::State& state) {
  if (!(state.last_step > 0.0) || !has_quasi_static_bodies(model)) return;
  const auto motions = dynamics::motions_of(model, state);
  dynamics::Forces forces;
  dynamics::evaluate_forces(model, motions, state.t, dynamics::circumstances_of(state), forces);
  for (std::size_t k = 0; k < model.loads.size(); ++k) {
    const model::Load& load = model.loads[k];
    const auto* motor = dynamic_cast<const loads::CoordinateServo*>(load.element.get());
    if (motor == nullptr) continue;
    const loads::RigidRow& row = forces.rigid[static_cast<std::size_t>(load.rigid_row)];
    const dynamics::LoadEnds ends = dynamics::ends_of(model, load, motions, &state.memory);
    const loads::Sight sight =
        dynamics::sight_of(model, k, state.t, dynamics::circumstances_of(state), ends);
    const double aimed = std::abs(sight.coordinate.rate - row.slip);
    const bool is_torn = row.is_closed && std::abs(row.slip) > kTorn * aimed &&
                         std::abs(row.slip) * state.last_step > kVisible;
    if (is_torn) motor->start_states(sight, state.memory.laws.data() + load.first_state);
  }
}

void settle_accelerations(const model::Model& model, const dynamics::MassMetric& metric,
                          const std::vector<int>& rows_in_use, model::State& state,
                          const std::vector<char>& given) {
  compute_accelerations(model, metric, rows_in_use, state, given);
  if (!has_quasi_static_bodies(model)) return;
  std::vector<Vector> lengths;  // that make displacements of coordinates
  for (const body::Body& body : model.bodies) {
    lengths.push_back(is_quasi_static(body) ? body::coordinate_lengths(body) : Vector());
  }
  std::size_t restless = 0;
  MixedRounds mixed;
  double last_change = HUGE_VAL;
  bool mixes = false;
  for (int round = 0; round < kMostRounds; ++round) {
    const Vector begin = gather(lengths, state);
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
      Vector d = deformation(model.bodies[b], s, forces.interface[b]);
      const Vector change_of_d = d - s.d.whole();
      const double size = d.cwiseAbs().maxCoeff();
      const double moved = change_of_d.cwiseAbs().maxCoeff();
      const double moved_by = change_of_d.cwiseProduct(lengths[b]).cwiseAbs().maxCoeff();
      s.d = std::move(d);
      const double share = moved_by > kNoChange * model.length ? moved / size : 0.0;
      if (!(share <= change)) restless = b;
      change = std::max(change, share);
    }
    mixes = mixes || !(change < last_change);
    last_change = change;
    if (mixes && change > kShapeSettled) {
      scatter(mixed.mix(begin, gather(lengths, state)), lengths, state);
    }
    close_positions(model, metric, state, model.bodies[restless].name);
    project_velocities(model, metric, state);
    compute_accelerations(model, metric, rows_in_use, state, given);
    if (change <= kShapeSettled) return;
  }
  refuse(model, state, model.bodies[restless].name);
}

}  // namespace buckens::analysis
