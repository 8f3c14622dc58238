// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <utility>

#include "buckens/loads/force_element.h"
#include "buckens/loads/spring_laws.h"

namespace buckens::loads {

/// A spring and damper on one joint coordinate whose force is projected onto a set:
///
///     f = proj_[lowest, highest](−k x − c ξ̇ + drive) − c₀ ξ̇
///
/// A plain spring admits all forces, a stop those of one sign (unilateral), friction those up to a
/// bound (bounded). Theory: docs/theory/22-rows.md §2.
struct ProjectedForce {
  bool is_on = true;                              ///< off: only c₀ acts
  double strain = 0;                              ///< x, from rest [m] or [rad]
  double stiffness = 0;                           ///< k [N/m] or [N m/rad]
  double damping = 0;                             ///< c [N s/m] or [N m s/rad]
  double lowest = -HUGE_VAL, highest = HUGE_VAL;  ///< [N] or [N m]
  double outer_damping = 0;                       ///< c₀, not limited by the set
  double drive = 0;        ///< added before the projection: what a motor is told [N] or [N m]
  double cut_damping = 0;  ///< how fast the end of the set falls with the rate, for the tangent
  /// The force of c is at most that of k, so that contact begins and ends without a jump.
  bool is_damper_limited = false;
  /// Where the set limits the force, rest follows so that k x becomes the force (return mapping);
  /// otherwise rest does not move.
  bool is_yielding = false;
  /// A motor: nothing is stored, all of its power comes from outside.
  bool is_source = false;
};

/// A projected force without its set.
struct UnlimitedForce {
  double excess = 0;                  ///< what the set keeps back [N] or [N m]
  double stiffness = 0, damping = 0;  ///< of all of it
};

/// What a law of a joint coordinate does, without what its force does to the markers.
struct CoordinateResponse {
  double force = 0;  ///< along the coordinate [N] or [N m]
  double stored_energy = 0, active_power = 0, dissipation = 0;  ///< as in Action
  /// After rest has followed: the state of a law that yields, if the step ends here.
  double strain = 0;
  int regime = 0;  ///< as in Action
};

/// What a force along a joint coordinate does to both markers.
Action along_coordinate(const CoordinateMotion& coordinate, double force);

/// A law of one joint coordinate. The force acts as Jᵀf on both markers of the joint.
class CoordinateLaw : public ForceElement {
 public:
  /// Zero: the law needs its coordinate, see respond().
  Action evaluate(double t, const spatial::MarkerMotion& first,
                  const spatial::MarkerMotion& second) const final;
  Action respond(const Sight& sight) const final;
  int num_soft_rows() const final { return 1; }
  void append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const final;
  int append_tangent_in_regime(const Sight& sight, std::vector<SoftRow>& rows) const final;
  int num_states() const final { return is_yielding() ? 1 : 0; }
  void find_states(const Sight& sight, double* states) const final;
  UnlimitedForce unlimited(const Sight& sight) const;
  /// What respond() says, at less cost.
  virtual CoordinateResponse answer(const Sight& sight) const;

 protected:
  virtual ProjectedForce force(const Sight& sight) const = 0;
  /// Whether rest follows: its strain is then a state.
  virtual bool is_yielding() const { return false; }
};

/// Linear spring and damper on a joint coordinate.
class CoordinateSpring final : public CoordinateLaw {
 public:
  /// @param free force-free value of the coordinate [m] or [rad]
  CoordinateSpring(base::SignalLaw stiffness, base::SignalLaw damping, base::SignalLaw free)
      : laws_(std::move(stiffness), std::move(damping), std::move(free)) {}

  bool uses_signals() const override { return laws_.uses_signals(); }
  bool has_driven_energy() const override { return laws_.drives_energy(); }
  bool is_constant() const override { return laws_.is_constant(); }

 private:
  ProjectedForce force(const Sight& sight) const override;
  SpringLaws laws_;
};

/// Elastic stops of a joint coordinate: a spring and damper beyond an end, which never pulls. The
/// damper is limited by the spring: a force that jumps with the speed of approach would leave a
/// step without a solution on either side of the end.
class CoordinateStop final : public CoordinateLaw {
 public:
  /// @param from,to ends of the free range [m] or [rad]; −HUGE_VAL, HUGE_VAL: none on that side
  CoordinateStop(double from, double to, double stiffness, double damping)
      : from_(from), to_(to), stiffness_(stiffness), damping_(damping) {}

 private:
  ProjectedForce force(const Sight& sight) const override;
  double from_, to_, stiffness_, damping_;
};

}  // namespace buckens::loads
