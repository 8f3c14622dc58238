// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <utility>

#include "buckens/loads/bristle_bending.h"
#include "buckens/loads/joint_friction.h"

namespace buckens::loads {

/// Dry friction of a ball in its socket by bending bristles: the law of BristleFriction for
/// rotations about any axis. The deflection z is a vector in axes of the first marker,
///
///     dz/ds = e − α(|z|) (e·z)₊ z σ₀/(|z| f_s);   T = −σ₀ z − σ₁ ż − σ₂ ω
///
/// over the way s along e: the part of e along z bends bristles no further once they slide, that
/// across it turns them. κ = 0 is LuGre's own law, dz/ds = e − σ₀ z/f_s. States: the rotation of
/// the second marker in the first, z, and the bound f_s. Theory: docs/theory/22-rows.md §4.
class BallBristles final : public ForceElement, public ReactionFollower {
 public:
  /// @param data with a radius
  BallBristles(const FrictionData& data, const BristleData& bristles,
               std::optional<FrictionLaws> laws = std::nullopt)
      : bound_(data, Eigen::Vector3d::Zero(), std::move(laws)), bristles_(bristles) {}

  bool uses_signals() const override { return bound_.uses_signals(); }
  bool is_constant() const override { return bound_.is_constant(); }

  /// Zero: the law needs its states, see respond().
  Action evaluate(double t, const spatial::MarkerMotion& first,
                  const spatial::MarkerMotion& second) const override;
  Action respond(const Sight& sight) const override;
  int num_soft_rows() const override { return 3; }
  void append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const override;
  void append_slopes(const Sight& sight, int regime,
                     std::vector<spatial::Wrench>& slopes) const override;
  double most_at_rest(const Sight& sight) const override;
  int num_states() const override { return 8; }
  void start_states(const Sight& sight, double* states) const override;
  void find_states(const Sight& sight, double* states) const override;

 private:
  /// In axes of the first marker.
  struct Bend {
    Eigen::Vector3d z = Eigen::Vector3d::Zero();      // [rad]
    Eigen::Vector3d z_dot = Eigen::Vector3d::Zero();  // [rad/s]
    Eigen::Vector3d rate = Eigen::Vector3d::Zero();   // ω [rad/s]
    double bound = 0;                                 // f_s [N m]
    double slope = 1;                                 // dz/ds along z
    double turn = 1;                                  // dz/ds across z
  };
  /// @param heavier factor on the reaction
  Bend bend(const Sight& sight, double heavier = 1.0) const;
  Eigen::Vector3d torque(const Sight& sight, const Bend& now) const;
  /// Directions of the tangent's rows: along z and across it, in axes of the first marker.
  static Eigen::Matrix3d directions(const Bend& now);

  DrivenBound bound_;
  BristleData bristles_;
};

}  // namespace buckens::loads
