// SPDX-License-Identifier: Apache-2.0
// Springs that no step can distinguish from rigid links.
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "buckens/dynamics/test/mechanism.h"
#include "buckens/loads/spring_damper.h"
#include "buckens/stepping/step_failure.h"
#include "buckens/stepping/stepper.h"

namespace buckens::stepping {
namespace {

/// A body that hangs on this number of parallel springs.
model::Model hanging_body(int springs, double stiffness) {
  test::Mechanism m;
  m.set_gravity({0, -9.81, 0});
  const int body = m.add_rigid(10.0, Eigen::Matrix3d::Identity(), {});
  const auto eye = m.rigid_marker(body, {1, 0, 0});
  for (int k = 0; k < springs; ++k) {
    m.add_load(std::make_unique<loads::SpringDamper>(stiffness, 0.0, 1.0, std::nullopt),
               test::Mechanism::ground({1, 1, 0}), eye);
  }
  return m.take();
}

TEST(StiffSprings, HoldTheirLengthLikeARigidLink) {
  // Rounding of the length, 1e-16 m, is a force of 1e-4 N beside the weight of 98 N, which
  // stretches it by 1e-10 m.
  const model::Model model = hanging_body(1, 1e12);
  Stepper stepper(model, StepSettings{}, {});
  model::State state = model::placed_state(model);
  for (int k = 0; k < 5; ++k) stepper.step(state);
  const Eigen::Vector3d eye = state.bodies[0].frame.X_WB * Eigen::Vector3d(1, 0, 0);
  EXPECT_NEAR((eye - Eigen::Vector3d(1, 1, 0)).norm(), 1.0, 1e-9);
  // It turns about the eye by m g r/(J + m r²); a first step without accelerations lags behind.
  EXPECT_NEAR(state.bodies[0].frame.w.z(), 98.1 / 11.0 * state.t, 0.2 * 98.1 / 11.0 * state.t);
}

TEST(StiffSprings, TwoThatNothingSetsApartAreNamed) {
  const model::Model model = hanging_body(2, 1e30);
  Stepper stepper(model, StepSettings{}, {});
  model::State state = model::placed_state(model);
  try {
    stepper.step(state);
    FAIL() << "took a step";
  } catch (const StepFailure& failure) {
    const std::string message = failure.what();
    EXPECT_NE(message.find("springs"), std::string::npos) << message;
    EXPECT_NE(message.find("body \"b0\""), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace buckens::stepping
