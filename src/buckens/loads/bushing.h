// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "buckens/base/characteristic.h"
#include "buckens/base/signal_law.h"
#include "buckens/loads/force_element.h"

namespace buckens::loads {

/// Six-DOF bushing: stiffness and damping along and about the axes of the first marker, force-free
/// as placed, with a characteristic beside them for each axis.
///
/// With r the displacement of the second marker in the first one's axes and θ the rotation vector
/// between them (both zero as placed): force −K r − C ṙ, torque −J_l⁻ᵀ(θ) K_r θ − C_r ω. The
/// elastic part derives from ½ rᵀK r + ½ θᵀK_r θ, so energy is conserved at any rotation below π.
/// Characteristics φ add φᵢ(rᵢ, ṙᵢ) to the force and φᵢ(θᵢ, 0) to K_r θ, which store ∫ φᵢ(s, 0) ds;
/// the rest φᵢ(θᵢ, ωᵢ) − φᵢ(θᵢ, 0) is lost like C_r ω.
/// About axes without stiffness it may rotate without limit; against stiffness up to 3 rad.
class Bushing final : public ForceElement {
 public:
  static constexpr double kLargestAngle = 3.0;  ///< [rad]; θ changes sign at π

  struct Coefficients {
    Eigen::Vector3d stiffness = Eigen::Vector3d::Zero();             ///< [N/m]
    Eigen::Vector3d rotational_stiffness = Eigen::Vector3d::Zero();  ///< [N m/rad]
    Eigen::Vector3d damping = Eigen::Vector3d::Zero();               ///< [N s/m]
    Eigen::Vector3d rotational_damping = Eigen::Vector3d::Zero();    ///< [N m s/rad]
    /// By displacement and rate along each axis [N], by angle and rate about it [N m].
    std::array<std::optional<base::Characteristic>, 3> forces{}, torques{};
    /// Multiply what it stores and what it loses; below zero they count as zero.
    base::SignalLaw stiffness_factor = 1.0, damping_factor = 1.0;
  };

  /// @param R_FM_placed orientation of the second marker in the first as placed
  /// @param r_F_placed position of the second marker in the first as placed [m]
  Bushing(const Coefficients& coefficients, const Eigen::Matrix3d& R_FM_placed,
          const Eigen::Vector3d& r_F_placed);

  /// @throws NumericalError beyond 3 rad against stiffness
  Action respond(const Sight& sight) const override;
  /// The same. @pre !uses_signals()
  Action evaluate(double t, const spatial::MarkerMotion& first,
                  const spatial::MarkerMotion& second) const override;
  int num_soft_rows() const override { return 6; }
  void append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const override;
  bool uses_signals() const override {
    return k_.stiffness_factor.uses_signals() || k_.damping_factor.uses_signals();
  }
  bool has_driven_energy() const override { return !k_.stiffness_factor.is_constant(); }
  bool is_constant() const override {
    return k_.stiffness_factor.is_constant() && k_.damping_factor.is_constant();
  }

 private:
  /// Displacement, rotation and their rates in axes of the first marker.
  struct Stand {
    Eigen::Vector3d r, r_dot, theta, w;
  };
  Stand look(const spatial::MarkerMotion& first, const spatial::MarkerMotion& second) const;

  Coefficients k_;
  Eigen::Vector3d resists_turns_;  // stiffness, or what stands for it where there is a curve
  Eigen::Matrix3d R_MF_placed_;
  Eigen::Vector3d r_F_placed_;
};

}  // namespace buckens::loads
