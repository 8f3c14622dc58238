// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "buckens/base/characteristic.h"
#include "buckens/base/signal_law.h"
#include "buckens/loads/force_element.h"
#include "buckens/loads/spring_laws.h"

namespace buckens::loads {

/// Spring and damper along the line between two markers: the tension
/// F = k (l − l0) + c l̇ + φ(l − l0, l̇) + f pulls both together. φ stores ∫ φ(s, 0) ds. k, c, l0
/// and f may follow time and signals.
class SpringDamper final : public ForceElement {
 public:
  /// @param stiffness k [N/m] ≥ 0
  /// @param damping c [N s/m] ≥ 0
  /// @param free_length l0 [m]
  /// @param tension f [N], optional
  /// @param curve φ [N], optional
  SpringDamper(base::SignalLaw stiffness, base::SignalLaw damping, base::SignalLaw free_length,
               std::optional<base::SignalLaw> tension,
               std::optional<base::Characteristic> curve = std::nullopt);

  /// @throws NumericalError if the markers coincide while the spring pulls, so that it has no
  /// direction
  Action respond(const Sight& sight) const override;
  /// The same. @pre !uses_signals()
  Action evaluate(double t, const spatial::MarkerMotion& first,
                  const spatial::MarkerMotion& second) const override;
  int num_soft_rows() const override { return 1; }
  void append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const override;
  bool uses_signals() const override {
    return laws_.uses_signals() || (tension_ && tension_->uses_signals());
  }
  bool has_driven_energy() const override { return laws_.drives_energy(); }
  bool is_constant() const override {
    return laws_.is_constant() && (!tension_ || tension_->is_constant());
  }

 private:
  SpringLaws laws_;
  std::optional<base::SignalLaw> tension_;
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
                  base::SignalLaw stiffness, base::SignalLaw damping, base::SignalLaw free_angle,
                  std::optional<base::Characteristic> curve = std::nullopt);

  /// Unit vector in the first marker.
  const Eigen::Vector3d& axis() const { return axis_F_; }

  /// @throws NumericalError beyond ±3 rad
  Action respond(const Sight& sight) const override;
  /// The same. @pre !uses_signals()
  Action evaluate(double t, const spatial::MarkerMotion& first,
                  const spatial::MarkerMotion& second) const override;
  int num_soft_rows() const override { return 1; }
  void append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const override;
  bool uses_signals() const override { return laws_.uses_signals(); }
  bool has_driven_energy() const override { return laws_.drives_energy(); }
  bool is_constant() const override { return laws_.is_constant(); }

 private:
  /// Angle from the position as placed, and its rate.
  struct Twist {
    double angle, rate;
  };
  Twist twist(const spatial::MarkerMotion& first, const spatial::MarkerMotion& second) const;

  Eigen::Vector3d axis_F_, x_F_, x_M_;
  SpringLaws laws_;
  std::optional<base::Characteristic> curve_;
};

}  // namespace buckens::loads
