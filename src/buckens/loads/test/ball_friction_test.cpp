// SPDX-License-Identifier: Apache-2.0
// How the rows of a ball that slides act together, against differences of its torque.
#include "buckens/loads/ball_friction.h"

#include <cmath>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

namespace buckens::loads {
namespace {

using Eigen::Vector3d;

FrictionData rubbing_ball() {
  FrictionData data;
  data.static_coefficient = data.dynamic_coefficient = 0.2;
  data.radius = 0.01;
  data.slip = 1e-3;
  data.inertia = 1e-4;
  return data;
}

/// Torque on the second marker, which turns with w, strained by the states.
Vector3d torque(const BallFriction& law, const std::vector<double>& states, const Vector3d& w) {
  spatial::MarkerMotion first, second;
  second.w = w;
  Sight sight{0.0, first, second};
  sight.reaction.force = {0, 30, 40};
  sight.states = states.data();
  return law.respond(sight).on_second.torque;
}

void expect_mix_of_differences(const Vector3d& strain, bool slides) {
  const BallFriction law(rubbing_ball(), std::nullopt);
  const std::vector<double> states = {1, 0, 0, 0, strain[0], strain[1], strain[2]};
  const Vector3d w(0.3, -0.2, 0.1);
  spatial::MarkerMotion first, second;
  second.w = w;
  Sight sight{0.0, first, second};
  sight.reaction.force = {0, 30, 40};
  sight.states = states.data();
  std::vector<SoftRow> rows;
  law.append_tangent(sight, rows);
  RowMix mix = RowMix::Identity(3, 3);
  EXPECT_EQ(law.mix_rows(sight, mix), slides);
  constexpr double kRate = 1e-6;
  for (int j = 0; j < 3; ++j) {
    const Vector3d dw = kRate * Vector3d::Unit(j);
    const Vector3d slope =
        (torque(law, states, w + dw) - torque(law, states, w - dw)) / (2.0 * kRate);
    for (int i = 0; i < 3; ++i) {
      // Central differences of second order: 1e-12 of the curvature, and rounding of 0.1 N m.
      EXPECT_NEAR(slope[i], -mix(i, j) * rows[static_cast<std::size_t>(j)].damping, 1e-8);
    }
  }
}

TEST(BallFriction, AnswersAcrossItsDirectionOfSliding) {
  expect_mix_of_differences({2e-3, 1e-3, -2e-3}, true);
}

TEST(BallFriction, AnswersAllAroundWhileItSticks) {
  expect_mix_of_differences({2e-4, 1e-4, -2e-4}, false);
}

/// Strained by 50 slips about the first arm, or the first axis, and turning fast enough that the
/// damper makes up for it but for half of the bound.
void expect_spring_to_break(const std::optional<BallFriction::Arms>& arms) {
  const FrictionData data = rubbing_ball();
  const BallFriction law(data, arms);
  const double bound = data.static_coefficient * data.radius * 50.0;
  const double damping = 2.0 * std::sqrt(bound / data.slip * data.inertia);
  const std::vector<double> states = {1, 0, 0, 0, -50 * data.slip, 0, 0};
  spatial::MarkerMotion first, second;
  second.w = {50.5 * bound / damping, 0, 0};
  Sight sight{0.0, first, second};
  sight.reaction.force = {0, 30, 40};
  sight.states = states.data();
  const Action action = law.respond(sight);
  // 1e-13: rounding of 5 N m.
  EXPECT_NEAR(action.on_second.torque.x(), -0.5 * bound, 1e-13);
  // No more than a spring bent by its slip holds, and no more than the torque takes.
  EXPECT_NEAR(action.stored_energy, 0.5 * bound * data.slip, 1e-15);
  EXPECT_NEAR(action.dissipation, 0.5 * bound * second.w.x(), 1e-11);
  std::vector<double> next(7);
  law.find_states(sight, next.data());
  EXPECT_NEAR(next[4], -data.slip, 1e-15);
}

TEST(BallFriction, SpringBreaksAwayWhereItsDamperMakesUpForTheStrain) {
  expect_spring_to_break(std::nullopt);
  expect_spring_to_break(BallFriction::Arms{Vector3d::UnitX(), Vector3d::UnitY()});
}

}  // namespace
}  // namespace buckens::loads
