// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/loads/coordinate_law.h"

namespace buckens::loads {

/// Parameters of dry friction in a joint.
struct FrictionData {
  double static_coefficient = 0;   ///< μ_s
  double dynamic_coefficient = 0;  ///< μ_d ≤ μ_s
  double stribeck_rate = 0;        ///< v_s [m/s] or [rad/s]; 0: μ_d as soon as it slides
  double viscous = 0;              ///< [N s/m] or [N m s/rad]
  double preload = 0;              ///< resistance without reaction [N] or [N m]
  double slip = 0;                 ///< break-away displacement [m] or [rad], > 0
  double inertia = 0;              ///< moving along the coordinate [kg] or [kg m²]; 0: no damping
  // Lever arms of the reaction [m]; for sliding joints radius is 1, so forces count directly.
  double radius = 0;          ///< of the pin: for forces across the axis
  double axial_radius = 0;    ///< for forces along the axis, of hinges
  double bearing_length = 0;  ///< that carries bending moments; 0: they are ignored
  double torque_radius = 0;   ///< at which sliding joints carry axial torque; 0: ignored
};

/// Dry friction on a joint coordinate by elastic stick with return mapping.
///
/// Within the bound b = μ N + b₀ the joint sticks by a spring that breaks away at the given slip;
/// beyond, it slides with b. It does not creep under constant loads below the bound. N comes from
/// the reaction of the joint. Theory: docs/theory/22-rows.md §4.
class JointFriction final : public CoordinateLaw {
 public:
  /// @param axis_F unit vector of the joint in the first marker
  JointFriction(const FrictionData& data, const Eigen::Vector3d& axis_F)
      : data_(data), axis_F_(axis_F) {}

  /// A joint that covers its slip within a millisecond slides from the start.
  void start_states(const Sight& sight, double* states) const override;

  /// Resistance due to the reaction per unit of the coefficient [N] or [N m].
  double load(const Sight& sight) const;

 private:
  ProjectedForce force(const Sight& sight) const override;
  bool is_yielding() const override { return true; }

  FrictionData data_;
  Eigen::Vector3d axis_F_;
};

}  // namespace buckens::loads
