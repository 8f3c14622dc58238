// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "buckens/base/characteristic.h"
#include "buckens/base/time_law.h"
#include "buckens/loads/force_element.h"

namespace buckens::loads {

/// Spring and damper along the line between two markers: the tension
/// F = k (l − l0) + c l̇ + φ(l − l0, l̇) + f(t) pulls both together. φ stores ∫ φ(s, 0) ds.
class SpringDamper final : public ForceElement {
 public:
  /// @param stiffness k [N/m] ≥ 0
  /// @param damping c [N s/m] ≥ 0
  /// @param free_length l0 [m]
  /// @param tension f(t) [N], optional
  /// @param curve φ [N], optional
  SpringDamper(double stiffness, double damping, double free_length,
               std::optional<base::TimeLaw> tension,
               std::optional<base::Characteristic> curve = std::nullopt);

  /// @throws NumericalError if the markers coincide while the spring pulls, so that it has no
  /// direction
  Action evaluate(double t, const spatial::MarkerMotion& first,
                  const spatial::MarkerMotion& second) const override;
  int num_soft_rows() const override { return 1; }
  void append_soft_rows(const spatial::MarkerMotion& first, const spatial::MarkerMotion& second,
                        std::vector<SoftRow>& rows) const override;
  bool is_constant() const override { return !tension_ || tension_->is_constant(); }

 private:
  double stiffness_, damping_, free_length_;
  std::optional<base::TimeLaw> tension_;
  std::optional<base::Characteristic> curve_;
};

/// Torsional spring and damper about an axis fixed in the first marker.
///
/// The angle is that of the second marker about the axis, zero as placed; it is measured within ±3
/// rad; beyond that the element throws (use a hinge-spring on a joint).
class TorsionalSpring final : public ForceElement {
 public:
  static constexpr double kLargestAngle = 3.0;  ///< [rad]; the measured angle jumps at π

  /// @param axis_F unit vector in the first marker
  /// @param R_FM_placed orientation of the second marker in the first as placed
  /// @param stiffness k [N m/rad] ≥ 0
  /// @param damping c [N m s/rad] ≥ 0
  /// @param free_angle [rad], @param curve torque by angle from there and rate [N m], optional
  TorsionalSpring(const Eigen::Vector3d& axis_F, const Eigen::Matrix3d& R_FM_placed,
                  double stiffness, double damping, double free_angle,
                  std::optional<base::Characteristic> curve = std::nullopt);

  /// Unit vector in the first marker.
  const Eigen::Vector3d& axis() const { return axis_F_; }

  /// @throws NumericalError beyond ±3 rad
  Action evaluate(double t, const spatial::MarkerMotion& first,
                  const spatial::MarkerMotion& second) const override;
  int num_soft_rows() const override { return 1; }
  void append_soft_rows(const spatial::MarkerMotion& first, const spatial::MarkerMotion& second,
                        std::vector<SoftRow>& rows) const override;

 private:
  /// Angle from that free of torque, and its rate.
  struct Twist {
    double angle, rate;
  };
  Twist twist(const spatial::MarkerMotion& first, const spatial::MarkerMotion& second) const;

  Eigen::Vector3d axis_F_, x_F_, x_M_;
  double stiffness_, damping_, free_angle_;
  std::optional<base::Characteristic> curve_;
};

}  // namespace buckens::loads
