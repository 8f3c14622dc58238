// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "buckens/analysis/statics/rest_rows.h"
#include "buckens/dynamics/mass_metric.h"
#include "buckens/model/model.h"
#include "buckens/model/state.h"

namespace buckens::analysis {

/// Result of a search for equilibrium.
struct StaticReport {
  int iterations = 0;
  int factorisations = 0;        ///< of stiffness matrices, one per flexible body
  long solves = 0;               ///< large solves with them
  double force_residual = 0;     ///< largest unbalanced force, torques divided by L [N]
  double largest_force = 0;      ///< largest single force, at start or end [N]
  double force_tolerance = 0;    ///< a force that is none [N]
  double position_residual = 0;  ///< largest |g| of the joints
  /// Smallest stiffness per mass along a free motion [1/s²], about the square of the lowest static
  /// frequency: zero without restoring force. Empty if nothing can move or it was not examined.
  std::optional<double> lowest_stiffness;
  std::vector<std::string> notes;  ///< what a user should know
  /// About what overlapped, and what friction could not hold.
  std::vector<std::string> warnings;
  RestStands rest;                ///< of the rows of force laws that hold, see RestRows
  RestOrder order;                ///< of the pairs that have rows among them
  std::vector<HeldContact> held;  ///< elastic contacts with frozen friction
};

/// Moves frames and meshes to a stable equilibrium under gravity, springs and loads at state.t,
/// with all joints closed and all velocities zero; λ is that of the equilibrium.
///
/// Newton on frames, interface values and λ with the meshes condensed by K⁺, guided by a vanishing
/// inertia W/τ² (pseudo-transient continuation): the path is that of strongly damped motion, so it
/// leads downhill from any start. An unstable equilibrium is left along its unstable motion. Joints
/// that rigid bodies cannot close are closed by deformation (preload). Converged at 1e-9 of the
/// largest force. Cost: one factor of K and one solve per interface row for each flexible body,
/// then small sparse systems. Theory: docs/theory/06-initial-state.md.
/// @param state assembled, or as close as rigid bodies come; its memory says which loads are off,
/// and gets the stands of rows that hold at rest
/// @param friction whether joints and rigid contacts that rub hold where they are
/// @param groups of this model; null: it has no rigid contact groups. They are left with the pairs
/// that are near each other in the equilibrium
/// @throws ModelError naming the body and the direction in
/// which nothing holds it, or the joint that cannot be
/// closed
/// @throws NumericalError if no equilibrium is found within 400 iterations
StaticReport find_static_equilibrium(const model::Model& model, model::State& state,
                                     model::RestFriction friction = model::RestFriction::free);

/// The same if the mass metric already exists.
StaticReport find_static_equilibrium(const model::Model& model, const dynamics::MassMetric& metric,
                                     model::State& state,
                                     model::RestFriction friction = model::RestFriction::free,
                                     model::RigidPairs* groups = nullptr);

class StaticDescent;

/// Descends until the equilibrium is stable as far as can be determined; fills lowest_stiffness and
/// notes.
/// @throws ModelError, NumericalError as find_static_equilibrium()
void settle_statically(const model::Model& model, StaticDescent& descent, StaticReport& report);

}  // namespace buckens::analysis
