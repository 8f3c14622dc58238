// SPDX-License-Identifier: Apache-2.0
// How the rows of a ball that slides act together, against differences of its torque.
#include "buckens/loads/ball_friction.h"

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

}  // namespace
}  // namespace buckens::loads
