// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "buckens/loads/joint_friction.h"
#include "buckens/loads/turning_friction.h"

namespace buckens::loads {

/// Dry friction of a ball in its socket, or of both bearings of a cross joint, from the reaction
/// of the joint: elastic stick with return mapping as JointFriction, on rotations.
///
/// In a ball the bound holds for the whole vector of the torque; in a cross joint for each of its
/// two arms. States: the rotation of the second marker in the first, and the strain: a vector in
/// axes of the first marker, or one number per arm. Theory: docs/theory/22-rows.md §4.
class BallFriction final : public ForceElement, public ReactionFollower, public TurningFriction {
 public:
  /// Arms of a cross joint: unit vectors in the first and in the second marker.
  struct Arms {
    Eigen::Vector3d first, second;
  };
  /// @param data with a radius; slip and inertia are those of rotation
  BallFriction(const FrictionData& data, std::optional<Arms> arms,
               std::optional<FrictionLaws> laws = std::nullopt)
      : bound_(data, Eigen::Vector3d::Zero(), std::move(laws)), arms_(std::move(arms)) {}

  bool uses_signals() const override { return bound_.uses_signals(); }
  bool is_constant() const override { return bound_.is_constant(); }

  /// Zero: the law needs its states, see respond().
  Action evaluate(double t, const spatial::MarkerMotion& first,
                  const spatial::MarkerMotion& second) const override;
  Action respond(const Sight& sight) const override;
  int num_soft_rows() const override { return 3; }
  void append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const override;
  bool mix_rows(const Sight& sight, RowMix& mix) const override;
  void append_slopes(const Sight& sight, int regime,
                     std::vector<spatial::Wrench>& slopes) const override;
  double most_at_rest(const Sight& sight) const override;
  bool has_arms() const override { return arms_.has_value(); }
  int num_states() const override { return 7; }
  void start_states(const Sight& sight, double* states) const override;
  void find_states(const Sight& sight, double* states) const override;
  Rub rub(const Sight& sight) const override;

 private:
  /// Torques along directions of the world, one after the other.
  struct Stand {
    Eigen::Matrix3d along;   // unit columns; the third is unused by arms
    Eigen::Vector3d torque;  // on the second marker, along the columns [N m]
    Eigen::Vector3d trial;   // the same without bound and viscous part
    Eigen::Vector3d strain;  // after rest has followed [rad]
    Eigen::Vector3d rate;    // [rad/s]
    std::array<bool, 3> slides{};
    std::array<bool, 3> broken{};  // sticks by its damper: the strain has been cut to the bound
    double stiffness = 0, damping = 0, viscous = 0;
    double bound_per_load = 0;  // relative growth of the bound with N [1/(N m)]
    double share = 1;           // of the trial torque of a ball that its bound admits
  };
  Stand look(const Sight& sight) const;
  /// Whether a soft row is that of a bearing: a cross joint has two.
  bool is_held(int row) const { return !(arms_ && row == 2); }

  DrivenBound bound_;
  std::optional<Arms> arms_;
};

}  // namespace buckens::loads
