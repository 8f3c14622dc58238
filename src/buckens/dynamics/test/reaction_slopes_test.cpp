// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/reaction_slopes.h"

#include <functional>
#include <memory>

#include <gtest/gtest.h>

#include "buckens/dynamics/forces.h"
#include "buckens/dynamics/row_memory.h"
#include "buckens/dynamics/test/example_models.h"
#include "buckens/joints/turning_rate.h"
#include "buckens/loads/ball_friction.h"
#include "buckens/loads/bristle_friction.h"
#include "buckens/loads/joint_friction.h"
#include "buckens/loads/rigid_ball_friction.h"

namespace buckens::dynamics {
namespace {

using Eigen::Vector3d;
using joints::JointType;
using linalg::Vector;

loads::FrictionData pin() {
  loads::FrictionData out;
  out.static_coefficient = out.dynamic_coefficient = 0.3;
  out.slip = 1e-3;
  out.inertia = 0.02;
  out.radius = 0.01;
  out.axial_radius = 0.03;
  out.bearing_length = 0.05;
  return out;
}

using AddLaw = std::function<void(test::Mechanism&)>;

/// A rod on a joint to a rod on a hinge, with friction.
model::Model rubbing_rods(JointType type, const AddLaw& add_law) {
  test::Mechanism m;
  const int lower = test::add_rod(m, 1.0, 1.0, {{0.5, 0, 0}, Eigen::Quaterniond::Identity()});
  const int upper = test::add_rod(m, 1.0, 1.0, {{1.5, 0, 0}, Eigen::Quaterniond::Identity()});
  m.add_joint(JointType::revolute, test::Mechanism::ground({0, 0, 0}),
              m.rigid_marker(lower, {-0.5, 0, 0}));
  m.add_joint(type, m.rigid_marker(lower, {0.5, 0, 0}), m.rigid_marker(upper, {-0.5, 0, 0}),
              Vector3d::UnitZ(), std::nullopt,
              [](joints::Placement& p) { p.second_axis_F = Vector3d::UnitX(); });
  add_law(m);
  return m.take();
}

/// Generalised forces of the only load, frames of both bodies one after the other.
Vector force_of_load(const model::Model& model, const model::State& state, const Vector& lambda) {
  Forces forces;
  Circumstances around = circumstances_of(state);
  around.lambda = &lambda;
  evaluate_forces(model, motions_of(model, state), 0.0, around, forces);
  Vector out(12);
  out << forces.frame[0], forces.frame[1];
  return out;
}

/// The slopes, with the directions of their rows, are the derivatives of the load's forces.
/// @param speed of turning at the joint, @param turned since the start of the step
void expect_the_derivatives(const model::Model& model, double speed, double turned = 0.0) {
  SCOPED_TRACE(speed);
  model::State state = model::placed_state(model);
  state.bodies[1].frame.w = speed * Vector3d(0.3, 0.2, 1);
  state.bodies[1].frame.v.y() = 0.5 * speed;
  state.memory = start_memory(model, motions_of(model, state));
  for (auto& before : state.memory.coordinates) before.fraction -= turned;
  // The elastic spring of friction, bent by a part of the slip.
  if (speed == 0.0) state.memory.laws.tail(1).setConstant(4e-4);
  state.lambda.resize(model.num_constraint_rows());
  for (Eigen::Index k = 0; k < state.lambda.size(); ++k) {
    state.lambda[k] = 20.0 + 3.0 * static_cast<double>(k * k);
  }
  const auto motions = motions_of(model, state);
  SoftRows soft;
  std::vector<ReactionSlope> slopes;
  const ReactionSlopes followers(model);
  evaluate_soft_rows(model, motions, 0.0, circumstances_of(state), soft, &followers, &slopes);
  ASSERT_FALSE(slopes.empty());
  const double step = 1e-3;
  double largest = 0.0;
  for (int row = 0; row < model.num_constraint_rows(); ++row) {
    Vector above = state.lambda, below = state.lambda;
    above[row] += step;
    below[row] -= step;
    const Vector expected =
        (force_of_load(model, state, above) - force_of_load(model, state, below)) / (2 * step);
    Vector found = Vector::Zero(12);
    for (const ReactionSlope& slope : slopes) {
      if (slope.row != row) continue;
      const SystemRow& direction = soft.rows[static_cast<std::size_t>(slope.soft)];
      for (const BodyRow* part : direction.parts()) {
        found.segment<6>(6 * part->body) += slope.value * part->frame.transpose();
      }
    }
    // Differences: truncation (step/λ)², rounding ε λ/step.
    EXPECT_LE((found - expected).norm(), 1e-8) << row;
    largest = std::max(largest, expected.norm());
  }
  EXPECT_GT(largest, 1e-3);
}

TEST(ReactionSlopes, AreThoseOfFrictionOfAHinge) {
  const model::Model model = rubbing_rods(JointType::revolute, [](test::Mechanism& m) {
    m.add_law(std::make_unique<loads::JointFriction>(pin(), Vector3d::UnitZ()),
              joints::JointCoordinate::angle(Vector3d::UnitZ(), Eigen::Matrix3d::Identity()));
  });
  for (const double speed : {0.0, 3.0, -3.0}) expect_the_derivatives(model, speed);
}

TEST(ReactionSlopes, AreThoseOfRigidFrictionThatSlides) {
  const model::Model model = rubbing_rods(JointType::revolute, [](test::Mechanism& m) {
    m.add_law(std::make_unique<loads::RigidFriction>(pin(), Vector3d::UnitZ()),
              joints::JointCoordinate::angle(Vector3d::UnitZ(), Eigen::Matrix3d::Identity()));
  });
  for (const double speed : {3.0, -3.0}) expect_the_derivatives(model, speed);
}

TEST(ReactionSlopes, AreThoseOfBristles) {
  // Bent partly forwards and backwards, and until they slide.
  for (const double bent : {3e-4, -3e-4, 2e-3}) {
    const model::Model model = rubbing_rods(JointType::revolute, [](test::Mechanism& m) {
      m.add_law(std::make_unique<loads::BristleFriction>(pin(), loads::BristleData{1e5, 3.0, 0.0},
                                                         Vector3d::UnitZ()),
                joints::JointCoordinate::angle(Vector3d::UnitZ(), Eigen::Matrix3d::Identity()));
    });
    for (const double speed : {0.7, -0.7}) expect_the_derivatives(model, speed, bent);
  }
}

TEST(ReactionSlopes, AreThoseOfABallThatSlides) {
  const model::Model model = rubbing_rods(JointType::spherical, [](test::Mechanism& m) {
    loads::FrictionData ball = pin();
    ball.axial_radius = ball.bearing_length = 0.0;
    m.add_law_of_joint(std::make_unique<loads::BallFriction>(ball, std::nullopt));
  });
  for (const double speed : {3.0, -3.0}) expect_the_derivatives(model, speed);
}

TEST(ReactionSlopes, AreThoseOfABallThatSticksRigidlyWhileItSlides) {
  const model::Model model = rubbing_rods(JointType::spherical, [](test::Mechanism& m) {
    for (int k = 0; k < loads::RigidBallFriction::kRows; ++k) {
      m.add_law(std::make_unique<loads::RigidBallFriction>(pin(), k),
                joints::JointCoordinate::measured(
                    std::make_shared<joints::TurningRate>(Vector3d::Unit(k))));
    }
  });
  for (const double speed : {3.0, -3.0}) expect_the_derivatives(model, speed);
}

}  // namespace
}  // namespace buckens::dynamics
