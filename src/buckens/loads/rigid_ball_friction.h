// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <utility>

#include "buckens/loads/joint_friction.h"

namespace buckens::loads {

/// Dry friction of a ball in its socket that sticks rigidly, about one axis of the first marker:
/// one of three rows, each a load of its own, that close all rotations as long as the bound admits
/// the whole torque,
///
///     |T| ≤ μ_s R N + b₀, else T = −(μ(|ω|) R N + b₀) ω/|ω| − c ω                          (R43)
///
/// with N the size of the force of the joint and ω that of the second marker against the first.
/// Regimes: 1 sticks; 2 slides against ω; RigidLaw::kHeldDirection and more: slides against the
/// torque of the stands, in a direction that the step has found.
///
/// Its coordinate is a joints::TurningRate. Sight::reaction is the force of the joint with the
/// torque of all three rows; it is the same for each of them, and so is what they decide.
class RigidBallFriction final : public RigidLaw, public ReactionFollower {
 public:
  static constexpr int kRows = 3;
  /// Rate whose direction says nothing [rad/s].
  static constexpr double kAtRest = 1e-9;

  /// @param data with a radius, @param axis 0, 1 or 2: x, y or z of the first marker
  RigidBallFriction(const FrictionData& data, int axis,
                    std::optional<FrictionLaws> laws = std::nullopt)
      : bound_(data, Eigen::Vector3d::Zero(), std::move(laws)), axis_(axis) {}

  int row_of_ball() const override { return axis_; }
  bool uses_signals() const override { return bound_.uses_signals(); }
  bool is_constant() const override { return bound_.is_constant(); }

  Action respond(const Sight& sight) const override;
  void append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const override;
  /// The last of the three says how they act together.
  bool mix_rows(const Sight& sight, RowMix& mix) const override;
  void append_slopes(const Sight& sight, int regime,
                     std::vector<spatial::Wrench>& slopes) const override;
  double most_at_rest(const Sight& sight) const override { return most(sight, 0.0); }
  /// Sticks at rest, slides where it moves.
  void start_states(const Sight& sight, double* states) const override;
  void find_states(const Sight& sight, double* states) const override;
  int struck_regime(const Sight& sight, double rounding) const override;

  /// The bound while it slides at this speed; at rest the largest [N m].
  double most(const Sight& sight, double speed) const;
  /// [N m s/rad]
  double viscous(const Sight& sight) const { return bound_.at(sight).data().viscous; }
  /// ω in axes of the first marker [rad/s].
  static Eigen::Vector3d rate(const Sight& sight);

 private:
  /// In axes of the first marker.
  struct Turn {
    Eigen::Vector3d rate, torque;  // ω [rad/s]; of the rows as they stand [N m]
    double speed = 0;              // [rad/s]
    double bound = 0;              // at this speed [N m]
    Eigen::Vector3d towards = Eigen::Vector3d::Zero();  // unit vector of sliding, or zero
    bool follows = false;                               // `towards` turns with ω
  };
  Turn look(const Sight& sight) const;
  RigidRow row(const Sight& sight) const override;

  DrivenBound bound_;
  int axis_;
};

}  // namespace buckens::loads
