// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/loads/coordinate_law.h"

namespace buckens::loads {

/// What dry friction in a joint is made of.
struct FrictionData {
  double static_coefficient = 0;   ///< μ_s
  double dynamic_coefficient = 0;  ///< μ_d ≤ μ_s
  double stribeck_rate = 0;        ///< v_s [m/s] or [rad/s]; 0: μ_d as soon as it moves
  double viscous = 0;              ///< [N s/m] or [N m s/rad]
  double preload = 0;              ///< resistance without reaction [N] or [N m]
  double slip = 0;                 ///< displacement at which it breaks away [m] or [rad], > 0
  double inertia = 0;              ///< moved along the coordinate [kg] or [kg m²]; 0: no damping
  // Levers of the reaction, [m]; of sliding joints radius is 1 and counts forces as they are.
  double radius = 0;          ///< of the pin: of forces across the axis
  double axial_radius = 0;    ///< of forces along the axis, of hinges
  double bearing_length = 0;  ///< that carries bending moments; 0: they are not counted
  double torque_radius = 0;   ///< at which sliding joints carry the torque about their axis; 0: not
};

/// Dry friction on a joint coordinate by elastic stick with return mapping.
///
/// Within the bound b = μ N + b₀ the joint holds by a spring that breaks away at the given slip;
/// beyond it slides with b. No constant load below the bound lets it creep. N comes from the
/// reaction of the joint. Theory: docs/theory/22-rows.md §4.
class JointFriction final : public CoordinateLaw {
 public:
  /// @param axis_F unit vector of the joint in the first marker
  JointFriction(const FrictionData& data, const Eigen::Vector3d& axis_F)
      : data_(data), axis_F_(axis_F) {}

  /// Whatever goes its slip within a millisecond slides from the start.
  void start_states(const Sight& sight, double* states) const override;

  /// Resistance that the reaction causes per unit of the coefficient [N] or [N m].
  double load(const Sight& sight) const;

 private:
  ProjectedForce force(const Sight& sight) const override;
  bool is_yielding() const override { return true; }

  FrictionData data_;
  Eigen::Vector3d axis_F_;
};

}  // namespace buckens::loads
