// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "buckens/loads/row_mix.h"
#include "buckens/spatial/marker_motion.h"

namespace buckens::loads {

/// Status of a rigid row: its force, and the part of its admissible set that contains the force.
/// Laws define the numbers of the parts; 0 is an inactive row.
struct RowStand {
  int regime = 0;
  double force = 0;  ///< along the joint coordinate [N] or [N m]
  /// For an open row that releases within the step: the correction of its force, (I8).
  double taken_back = 0;
};

/// A rigid row: while it is closed, its force is whatever keeps it closed.
struct RigidRow {
  bool is_closed = false;
  bool holds_position = false;  ///< otherwise its rate only
  bool may_go = false;          ///< there may be nothing to hold on to, or another place
  bool has_gone = false;        ///< opens at once: there is nothing to hold on to any more
  double gap = 0;               ///< of the position, to be closed [m] or [rad]
  double slip = 0;              ///< of the rate, to be closed [m/s] or [rad/s]
  double given = 0;             ///< force of a row that is not closed [N] or [N m]
  RowStand next;                ///< where its set puts it: equal to where it stands, or a change
};

/// The effect of a force element at one configuration.
struct Action {
  spatial::Wrench on_first;   ///< on the first marker, world components
  spatial::Wrench on_second;  ///< on the second marker, world components
  /// Load along Load::pattern_row of the first body [N]; evaluate() omits its power, which needs
  /// the rate of that row.
  double along_pattern = 0;
  double stored_energy = 0;     ///< of its springs [J]
  double active_power = 0;      ///< power supplied to the system beyond −d(stored_energy)/dt [W]
  double dissipation = 0;       ///< power dissipated by dampers, negative part of active_power [W]
  double friction = 0;          ///< part of the dissipation in contacts that rub [W]
  double along_coordinate = 0;  ///< force along its joint coordinate [N] or [N m]
  int regime = 0;  ///< which of its tangents applies; a change makes them be formed again
  RigidRow row{};  ///< of laws with a rigid row
};

/// A direction in which a force element resists: the generalised displacement x with ẋ = J V causes
/// the generalised force −k x − c ẋ. Used only for the tangent of the step's iteration.
struct SoftRow {
  spatial::PairRow J = spatial::PairRow::Zero();
  double stiffness = 0;   ///< [N/m] or [N m/rad]
  double damping = 0;     ///< [N s/m] or [N m s/rad]
  bool is_rigid = false;  ///< closed without any give; stiffness and damping say nothing
};

/// Derivatives of a scalar with respect to the twist (w, v) of a marker, in world components.
using TwistRow = Eigen::Matrix<double, 1, 6>;

/// A joint coordinate at an instant: an angle with whole turns [rad] or a displacement [m].
struct CoordinateMotion {
  double value = 0;
  double rate = 0;    ///< J V
  double change = 0;  ///< change since the start of the step, accurate also after many turns
  spatial::PairRow J = spatial::PairRow::Zero();
};

/// Input of a force law at an instant.
struct Sight {
  double t = 0;
  const spatial::MarkerMotion& first;
  const spatial::MarkerMotion& second;
  CoordinateMotion coordinate{};   ///< of laws on a joint coordinate
  spatial::Wrench reaction{};      ///< of the law's joint, on the second marker, world axes
  const double* states = nullptr;  ///< num_states() at the start of the step; null: all zero
  RowStand stand{};                ///< of laws with a rigid row: as it is now
  /// t and the values of all signals of the model at this instant; empty if it has none.
  std::span<const double> signals{};
  /// For elements with more than two markers: the third and all further ones.
  std::span<const spatial::MarkerMotion> others{};
};

/// A force law between two marker frames. An applied load has the ground as its second marker.
///
/// Most laws depend on time and both markers and need only evaluate() and append_soft_rows().
/// Others depend on a joint coordinate, the reaction of their joint, or internal states, which the
/// model's state stores; these override respond() and append_tangent(). A cable has more than two
/// markers; separate functions return its effect on the others.
class ForceElement {
 public:
  virtual ~ForceElement() = default;

  /// Its effect, from time and markers only.
  virtual Action evaluate(double t, const spatial::MarkerMotion& first,
                          const spatial::MarkerMotion& second) const = 0;
  /// Its effect, from all available input.
  virtual Action respond(const Sight& sight) const {
    return evaluate(sight.t, sight.first, sight.second);
  }

  /// Number of soft rows, constant over time; zero for elements without stiffness and damping.
  virtual int num_soft_rows() const { return 0; }

  /// Appends num_soft_rows() rows.
  virtual void append_soft_rows(const spatial::MarkerMotion& /*first*/,
                                const spatial::MarkerMotion& /*second*/,
                                std::vector<SoftRow>& /*rows*/) const {}
  virtual void append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const {
    append_soft_rows(sight.first, sight.second, rows);
  }

  /// Appends the same, and says which of its tangents that is: Action::regime.
  virtual int append_tangent_in_regime(const Sight& sight, std::vector<SoftRow>& rows) const {
    append_tangent(sight, rows);
    return respond(sight).regime;
  }

  /// Adds the wrenches on its third and further markers, one for each.
  virtual void add_to_others(const Sight& /*sight*/,
                             std::span<spatial::Wrench> /*wrenches*/) const {}
  /// The parts of the rows of append_tangent() that belong to these markers, row by row.
  virtual void append_others_of_rows(const Sight& /*sight*/,
                                     std::vector<TwistRow>& /*rows*/) const {}
  /// Coupling of these rows. @return false if they are independent; `mix` is then not written
  virtual bool mix_rows(const Sight& /*sight*/, RowMix& /*mix*/) const { return false; }

  /// Whether its soft row is a rigid one. Its first two states are RowStand::regime and force.
  virtual bool is_rigid() const { return false; }

  /// Number of its states, which persist from step to step.
  virtual int num_states() const { return 0; }
  /// Writes the states before the first step. @param states all zero on entry
  virtual void start_states(const Sight& /*sight*/, double* /*states*/) const {}
  /// The same if an event switches it on during a run. @param states all zero on entry
  virtual void restart_states(const Sight& sight, double* states) const {
    start_states(sight, states);
  }
  /// Writes the states at the end of a step.
  /// @param sight at the end, with the states at the start
  virtual void find_states(const Sight& /*sight*/, double* /*states*/) const {}

  /// Whether it uses Sight::signals.
  virtual bool uses_signals() const { return false; }
  /// Whether its stored energy depends on time or signals. Energy gained because these change, at
  /// fixed motion, is external and not part of Action::active_power.
  virtual bool has_driven_energy() const { return false; }

  /// Whether it is an external load, which a static path multiplies by its load factor.
  virtual bool is_applied() const { return false; }

  /// Number of laws of time whose values are recorded: three components, one pressure, or none.
  virtual int num_values() const { return 0; }
  /// Their values, num_values() of the three: components in world axes, or in axes of the first
  /// marker if follows().
  virtual Eigen::Vector3d values(double /*t*/) const { return Eigen::Vector3d::Zero(); }
  virtual bool follows() const { return false; }

  /// Whether values can be set from outside instead of the laws of time, as for forces and torques.
  virtual bool takes_values() const { return false; }
  /// Its effect with these values, axes as for values(). @pre takes_values()
  virtual Action act(const Eigen::Vector3d& /*values*/,
                     const spatial::MarkerMotion& /*first*/) const {
    return {};
  }

  /// False if the load varies with time; a static start uses its value at t = 0.
  virtual bool is_constant() const { return true; }
};

}  // namespace buckens::loads
