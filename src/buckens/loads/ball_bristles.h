// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <utility>

#include "buckens/loads/ball_bending.h"
#include "buckens/loads/bristle_bending.h"
#include "buckens/loads/joint_friction.h"
#include "buckens/loads/turning_friction.h"

namespace buckens::loads {

/// Dry friction of a ball in its socket by bending bristles: the law of BristleFriction for
/// rotations about any axis, T = −σ₀ z − σ₁ ż − σ₂ ω in axes of the first marker, see BallBending.
/// States: the rotation of the second marker in the first, z, and the bound f_s.
/// Theory: docs/theory/22-rows.md §4.
class BallBristles final : public ForceElement, public ReactionFollower, public TurningFriction {
 public:
  /// @param data with a radius
  BallBristles(const FrictionData& data, const BristleData& bristles,
               std::optional<FrictionLaws> laws = std::nullopt)
      : bound_(data, Eigen::Vector3d::Zero(), std::move(laws)),
        bristles_(bristles),
        bending_(bristles.elastic_share) {}

  bool uses_signals() const override { return bound_.uses_signals(); }
  bool is_constant() const override { return bound_.is_constant(); }

  /// Zero: the law needs its states, see respond().
  Action evaluate(double t, const spatial::MarkerMotion& first,
                  const spatial::MarkerMotion& second) const override;
  Action respond(const Sight& sight) const override;
  /// Three for the deflection and three for rates.
  int num_soft_rows() const override { return 6; }
  void append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const override;
  bool mix_rows(const Sight& sight, RowMix& mix) const override;
  void append_slopes(const Sight& sight, int regime,
                     std::vector<spatial::Wrench>& slopes) const override;
  double most_at_rest(const Sight& sight) const override;
  int num_states() const override { return 8; }
  void start_states(const Sight& sight, double* states) const override;
  void find_states(const Sight& sight, double* states) const override;
  Rub rub(const Sight& sight) const override;

 private:
  /// In axes of the first marker.
  struct Bend {
    BallBending::Way way;
    Eigen::Vector3d z = Eigen::Vector3d::Zero();      // [rad]
    Eigen::Vector3d z_dot = Eigen::Vector3d::Zero();  // [rad/s]
    Eigen::Vector3d rate = Eigen::Vector3d::Zero();   // ω [rad/s]
    double bound = 0;                                 // f_s [N m]
    double viscous = 0;                               // σ₂ [N m s/rad]
    bool slips = false;
  };
  /// @param heavier factor on the reaction
  Bend bend(const Sight& sight, double heavier = 1.0) const;
  Eigen::Vector3d torque(const Bend& now) const;
  /// How the torque falls with a rotation [N m/rad] and with its rate [N m s/rad].
  struct Tangent {
    Eigen::Matrix3d stiffness, damping;
  };
  Tangent tangent(const Bend& now) const;

  DrivenBound bound_;
  BristleData bristles_;
  BallBending bending_;
};

}  // namespace buckens::loads
