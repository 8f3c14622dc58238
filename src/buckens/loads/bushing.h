// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/loads/force_element.h"

namespace buckens::loads {

/// Linear six-DOF bushing: stiffness and damping along and about the axes of the first marker,
/// force-free as placed.
///
/// With r the displacement of the second marker in the first one's axes and θ the rotation vector
/// between them (both zero as placed): force −K r − C ṙ, torque −J_l⁻ᵀ(θ) K_r θ − C_r ω. The
/// elastic part derives from ½ rᵀK r + ½ θᵀK_r θ, so energy is conserved at any rotation below π.
/// About axes without stiffness it may rotate without limit; against stiffness up to 3 rad.
class Bushing final : public ForceElement {
 public:
  static constexpr double kLargestAngle = 3.0;  ///< [rad]; θ changes sign at π

  struct Coefficients {
    Eigen::Vector3d stiffness = Eigen::Vector3d::Zero();             ///< [N/m]
    Eigen::Vector3d rotational_stiffness = Eigen::Vector3d::Zero();  ///< [N m/rad]
    Eigen::Vector3d damping = Eigen::Vector3d::Zero();               ///< [N s/m]
    Eigen::Vector3d rotational_damping = Eigen::Vector3d::Zero();    ///< [N m s/rad]
  };

  /// @param R_FM_placed orientation of the second marker in the first as placed
  /// @param r_F_placed position of the second marker in the first as placed [m]
  Bushing(const Coefficients& coefficients, const Eigen::Matrix3d& R_FM_placed,
          const Eigen::Vector3d& r_F_placed);

  /// @throws NumericalError beyond 3 rad against stiffness
  Action evaluate(double t, const spatial::MarkerMotion& first,
                  const spatial::MarkerMotion& second) const override;
  int num_soft_rows() const override { return 6; }
  void append_soft_rows(const spatial::MarkerMotion& first, const spatial::MarkerMotion& second,
                        std::vector<SoftRow>& rows) const override;

 private:
  Coefficients k_;
  Eigen::Matrix3d R_MF_placed_;
  Eigen::Vector3d r_F_placed_;
};

}  // namespace buckens::loads
