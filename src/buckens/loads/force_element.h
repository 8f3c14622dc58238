// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/spatial/marker_motion.h"

namespace buckens::loads {

/// What a force element does at one configuration.
struct Action {
  spatial::Wrench on_first;   ///< on the first marker, world components
  spatial::Wrench on_second;  ///< on the second marker, world components
  /// Load along Load::pattern_row of the first body [N]; evaluate() leaves its power out, which
  /// takes the rate of that row.
  double along_pattern = 0;
  double stored_energy = 0;  ///< of its springs [J]
  double active_power = 0;   ///< power given to the system beyond −d(stored_energy)/dt [W]
  double dissipation = 0;    ///< power taken by dampers, contained in active_power with minus [W]
  double along_coordinate = 0;  ///< force along its joint coordinate [N] or [N m]
  int regime = 0;  ///< which of its tangents holds; where it changes, they are formed anew
};

/// A direction in which a force element resists: the generalised displacement x with ẋ = J V meets
/// the generalised force −k x − c ẋ. Only the tangent of the step's iteration is made of it.
struct SoftRow {
  spatial::PairRow J = spatial::PairRow::Zero();
  double stiffness = 0;  ///< [N/m] or [N m/rad]
  double damping = 0;    ///< [N s/m] or [N m s/rad]
};

/// A joint coordinate at one instant: an angle counted over turns [rad] or a displacement [m].
struct CoordinateMotion {
  double value = 0;
  double rate = 0;    ///< J V
  double change = 0;  ///< since the start of the step, with all digits after many turns, too
  spatial::PairRow J = spatial::PairRow::Zero();
};

/// All that a force law may see at one instant.
struct Sight {
  double t = 0;
  const spatial::MarkerMotion& first;
  const spatial::MarkerMotion& second;
  CoordinateMotion coordinate{};   ///< of laws on a joint coordinate
  spatial::Wrench reaction{};      ///< of the law's joint, on the second marker, world axes
  const double* states = nullptr;  ///< num_states() at the start of the step; null: all zero
};

/// A force law between two marker frames. An applied load has the ground as its second marker.
///
/// Most laws are made of time and both markers and need evaluate() and append_soft_rows() only.
/// Others see a joint coordinate, the reaction of their joint, or states of their own, which the
/// model's state keeps for them; these override respond() and append_tangent().
class ForceElement {
 public:
  virtual ~ForceElement() = default;

  /// What it does by time and markers alone.
  virtual Action evaluate(double t, const spatial::MarkerMotion& first,
                          const spatial::MarkerMotion& second) const = 0;
  /// What it does by all that it may see.
  virtual Action respond(const Sight& sight) const {
    return evaluate(sight.t, sight.first, sight.second);
  }

  /// Number of soft rows, the same at any time; zero for elements without stiffness and damping.
  virtual int num_soft_rows() const { return 0; }

  /// Appends num_soft_rows() rows.
  virtual void append_soft_rows(const spatial::MarkerMotion& /*first*/,
                                const spatial::MarkerMotion& /*second*/,
                                std::vector<SoftRow>& /*rows*/) const {}
  virtual void append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const {
    append_soft_rows(sight.first, sight.second, rows);
  }

  /// Numbers that it keeps from step to step.
  virtual int num_states() const { return 0; }
  /// Writes these numbers as they are before the first step. @param states all zero
  virtual void start_states(const Sight& /*sight*/, double* /*states*/) const {}
  /// Writes these numbers as they are at the end of a step.
  /// @param sight at the end, with the states at the start
  virtual void find_states(const Sight& /*sight*/, double* /*states*/) const {}

  /// True for loads that come from outside: a static path multiplies them by its load factor.
  virtual bool is_applied() const { return false; }

  /// Number of laws of time whose values are recorded: three components, one pressure, none.
  virtual int num_values() const { return 0; }
  /// Their values, the first num_values() of three: components in world axes, or in those of the
  /// first marker where follows() says so.
  virtual Eigen::Vector3d values(double /*t*/) const { return Eigen::Vector3d::Zero(); }
  virtual bool follows() const { return false; }

  /// Whether values can be given from outside in place of the laws of time: forces and torques.
  virtual bool takes_values() const { return false; }
  /// What it does with these values, axes as for values(). @pre takes_values()
  virtual Action act(const Eigen::Vector3d& /*values*/,
                     const spatial::MarkerMotion& /*first*/) const {
    return {};
  }

  /// False if the load changes with time by a law; a static start takes its value at t = 0.
  virtual bool is_constant() const { return true; }
};

}  // namespace buckens::loads
