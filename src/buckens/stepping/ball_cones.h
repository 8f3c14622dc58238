// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/loads/rigid_ball_friction.h"
#include "buckens/stepping/push_answers.h"
#include "buckens/stepping/rigid_instant.h"
#include "buckens/stepping/rigid_rows.h"

namespace buckens::stepping {

/// Friction of balls that stick rigidly, in the iteration of a step: which of them stick or slide,
/// and in which direction, is decided for all of them together.
///
/// From the torques and rates that the iteration has reached, torques are found that stay within
/// their bounds, as these are now, with the changes of rates that they cause; the rows get the
/// stands that follow. Theory: docs/theory/23-impacts.md §3.
class BallCones {
 public:
  /// What is known of the iteration at the instant.
  struct Stage {
    /// Of each soft row, in the units of `compliance`: 1/k of springs and dampers within the step;
    /// null: they are left out.
    const std::vector<double>* soft_compliance = nullptr;
    /// Everything else has settled: balls that slide with ω go on doing so unless they stick.
    bool is_settled = false;
    /// RigidRow::slip is what rates are about to become: balls that turn already are left as they
    /// are.
    bool begins = false;
  };

  explicit BallCones(const model::Model& model);

  bool empty() const { return balls_.empty(); }
  /// Per rigid row: whether it is one of those that are decided here.
  const std::vector<char>& rows() const { return is_own_; }
  /// Whether the stands of all balls agree with their torques and rates.
  /// @param rows of the iteration
  bool hold(const std::vector<loads::RigidRow>& rows, const RigidRows& rigid) const;
  bool any_slides(const RigidRows& rigid) const;
  /// Decides the stands of all balls afresh.
  /// @param per_force,per_change `compliance` times per_force is the displacement due to a force;
  ///        times per_change as well, it is the change of the rate
  /// @return whether the stand of any row has changed
  bool decide(const RigidInstant& now, const Stage& stage, double per_force, double per_change,
              RigidRows& rigid);

 private:
  struct Ball {
    std::size_t load;  ///< the first of its three
    int rigid, soft;   ///< the first of its rigid and of its soft rows
    const loads::RigidBallFriction* law;
  };
  /// Three components for each of the balls that are decided.
  struct Balls {
    std::vector<const Ball*> all;
    std::vector<double> most;              ///< of each [N m]
    linalg::Vector torque, rate, viscous;  ///< dry torque [N m], [rad/s], [N m s/rad]
  };
  static bool holds(const Ball& ball, const std::vector<loads::RigidRow>& rows,
                    const RigidRows& rigid);
  Balls gather(const RigidInstant& now, const Stage& stage, const RigidRows& rigid) const;
  bool condense(const RigidInstant& now, const Stage& stage);
  linalg::Matrix answers(const RigidInstant& now, const Balls& balls) const;
  static bool put(const Ball& ball, const Eigen::Vector3d& torque, bool sticks, RigidRows& rigid);

  const model::Model& model_;
  PushAnswers answers_;
  std::vector<Ball> balls_;
  std::vector<char> is_own_;
};

}  // namespace buckens::stepping
