// SPDX-License-Identifier: Apache-2.0
// Rows of a ball that slides, against differences of its torque, and what they decide together.
#include "buckens/loads/rigid_ball_friction.h"

#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/spatial/rotation.h"

namespace buckens::loads {
namespace {

using Eigen::Vector3d;

FrictionData slippery_ball() {
  FrictionData data;
  data.static_coefficient = data.dynamic_coefficient = 0.2;
  data.radius = 0.01;
  data.viscous = 0.003;
  return data;
}
constexpr double kMost = 0.2 * 0.01 * 50.0;  // with the force below

/// Three rows of a ball under 50 N that turns with w, as their stands say.
class RubbingBall {
 public:
  RubbingBall(const Vector3d& w, int regime, const Vector3d& torque) : torque_F_(torque) {
    first_.R = spatial::exp_rotation(Vector3d(0.3, -0.5, 0.2)).toRotationMatrix();
    first_.w = {0.1, 0.2, -0.3};
    second_.w = first_.w + w;
    regime_ = regime;
  }

  void turn_by(const Vector3d& dw) { second_.w += dw; }
  Sight sight(int axis) const {
    Sight out{0.0, first_, second_};
    const Vector3d a = first_.R.col(axis);
    out.coordinate.J.segment<3>(0) = -a.transpose();
    out.coordinate.J.segment<3>(6) = a.transpose();
    out.coordinate.rate = a.dot(second_.w - first_.w);
    out.reaction.force = {0, 30, 40};
    out.reaction.torque = first_.R * torque_F_;
    out.stand = {regime_, torque_F_[axis]};
    out.states = kBeganSliding.data();
    return out;
  }
  static RigidBallFriction law(int axis) { return {slippery_ball(), axis}; }
  const Eigen::Matrix3d& axes() const { return first_.R; }
  /// In axes of the first marker.
  Vector3d torque() const {
    Vector3d out = Vector3d::Zero();
    for (int k = 0; k < 3; ++k) out += law(k).respond(sight(k)).on_second.torque;
    return axes().transpose() * out;
  }
  std::array<RigidRow, 3> rows() const {
    return {law(0).respond(sight(0)).row, law(1).respond(sight(1)).row,
            law(2).respond(sight(2)).row};
  }

 private:
  static constexpr std::array<double, 2> kBeganSliding{2.0, 0.0};
  spatial::MarkerMotion first_, second_;
  Vector3d torque_F_;
  int regime_;
};

TEST(RigidBallFriction, AnswersAcrossItsDirectionOfSliding) {
  const Vector3d w(0.3, -0.2, 0.1);
  RubbingBall ball(w, 2, Vector3d::Zero());
  std::vector<SoftRow> rows;
  for (int k = 0; k < 3; ++k) RubbingBall::law(k).append_tangent(ball.sight(k), rows);
  RowMix mix;
  EXPECT_FALSE(RubbingBall::law(0).mix_rows(ball.sight(0), mix));
  ASSERT_TRUE(RubbingBall::law(2).mix_rows(ball.sight(2), mix));
  constexpr double kRate = 1e-6;
  for (int j = 0; j < 3; ++j) {
    const Vector3d dw = kRate * ball.axes().col(j);
    RubbingBall more = ball, less = ball;
    more.turn_by(dw);
    less.turn_by(-dw);
    const Vector3d slope = (more.torque() - less.torque()) / (2.0 * kRate);
    for (int i = 0; i < 3; ++i) {
      // Central differences: 1e-12 of the curvature, and rounding of 0.1 N m.
      EXPECT_NEAR(slope[i], -mix(i, j) * rows[static_cast<std::size_t>(j)].damping, 1e-8);
    }
  }
}

TEST(RigidBallFriction, SlidesWithItsBoundAgainstTheRotation) {
  const Vector3d w(0.3, -0.2, 0.1);
  const RubbingBall ball(w, 2, Vector3d::Zero());
  const Vector3d w_F = ball.axes().transpose() * w;
  const Vector3d expected = -kMost * w_F.normalized() - slippery_ball().viscous * w_F;
  EXPECT_NEAR((ball.torque() - expected).norm(), 0.0, 1e-16);
}

TEST(RigidBallFriction, LetsGoOnlyWhereTheWholeTorqueIsTooLarge) {
  // Each component is within the bound.
  const Vector3d way = Vector3d(2, -1, 2) / 3.0;
  for (const double share : {0.999, 1.001}) {
    const RubbingBall ball(Vector3d::Zero(), 1, share * kMost * way);
    for (const RigidRow& row : ball.rows()) {
      EXPECT_TRUE(row.is_closed);
      EXPECT_EQ(row.next.regime, share > 1.0 ? 2 : 1);
    }
    if (share < 1.0) continue;
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(ball.rows()[static_cast<std::size_t>(k)].next.force, kMost * way[k], 1e-16);
    }
  }
}

TEST(RigidBallFriction, SticksWhereTheRotationHasTurnedRound) {
  const Vector3d w(0.3, -0.2, 0.1);
  RubbingBall forwards(w, 2, Vector3d::Zero());
  const Vector3d before = -kMost * (forwards.axes().transpose() * w).normalized();
  for (const bool has_turned : {false, true}) {
    const RubbingBall ball(has_turned ? Vector3d(-w) : w, 2, before);
    for (const RigidRow& row : ball.rows()) EXPECT_EQ(row.next.regime, has_turned ? 1 : 2);
    // Until it sticks it goes on rubbing as it did, and does not turn with the rotation.
    EXPECT_GT(ball.torque().dot(before), 0.0);
  }
}

TEST(RigidBallFriction, KeepsADirectionThatTheStepHasFound) {
  const Vector3d torque(0.03, 0.02, -0.01);
  const Vector3d w(0.3, 0.2, 0.1);
  const RubbingBall ball(w, RigidLaw::kHeldDirection, torque);
  const Vector3d viscous = slippery_ball().viscous * (ball.axes().transpose() * w);
  EXPECT_NEAR((ball.torque() + viscous - kMost * torque.normalized()).norm(), 0.0, 1e-16);
  RowMix mix;
  EXPECT_FALSE(RubbingBall::law(2).mix_rows(ball.sight(2), mix));
}

}  // namespace
}  // namespace buckens::loads
