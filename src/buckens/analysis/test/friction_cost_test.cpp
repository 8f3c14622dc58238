// SPDX-License-Identifier: Apache-2.0
// What friction in all joints adds to the steps of a flexible slider-crank, in counts.
#include <cmath>
#include <memory>
#include <numbers>

#include <gtest/gtest.h>

#include "buckens/analysis/simulation/work_account.h"
#include "buckens/base/test/allocation_count.h"
#include "buckens/dynamics/test/example_models.h"
#include "buckens/loads/joint_friction.h"
#include "buckens/stepping/stepper.h"

namespace buckens::stepping {
namespace {

using Eigen::Vector3d;
using joints::JointCoordinate;
using joints::JointType;
using test::Mechanism;

constexpr std::size_t kRod = 1;

std::unique_ptr<loads::JointFriction> friction(double radius, double slip, const Vector3d& axis) {
  loads::FrictionData data;
  data.static_coefficient = data.dynamic_coefficient = 0.1;
  data.radius = radius;
  data.slip = slip;
  data.inertia = 1e-4;
  return std::make_unique<loads::JointFriction>(data, axis);
}

/// Crank of 0.15 m driven at 150 rad/s, steel rod of 0.3 m and 8 mm in eight beam elements, slider.
model::Model slider_crank(bool rubs) {
  Mechanism m(spatial::Plane::xy);
  m.set_length(0.45);
  const double A = std::numbers::pi * 0.004 * 0.004;
  test::BeamConstants rod;
  rod.L = 0.3;
  rod.rhoA = 7870.0 * A;
  rod.EA = 2e11 * A;
  rod.EIy = rod.EIz = 0.25 * rod.EA * 0.004 * 0.004;
  rod.beta = 1e-6;
  rod.elements = 8;
  const Eigen::Quaterniond straight = Eigen::Quaterniond::Identity();
  const int crank = test::add_rod(m, 0.36, 0.15, {{0.075, 0, 0}, straight});
  const int beam =
      m.add_flexible(test::straight_beam(rod, spatial::Plane::xy), {}, {{0.15, 0, 0}, straight});
  const int slider =
      m.add_rigid(0.033, Eigen::Matrix3d::Identity() * 1e-6, {{0.45, 0, 0}, straight});
  const auto hinge = [&](const model::MarkerId& first, const model::MarkerId& second,
                         double radius) {
    m.add_joint(JointType::revolute, first, second);
    if (!rubs) return;
    m.add_law(friction(radius, 1e-4, Vector3d::UnitZ()),
              JointCoordinate::angle(Vector3d::UnitZ(), Eigen::Matrix3d::Identity()));
  };
  const auto hub = m.rigid_marker(crank, {-0.075, 0, 0});
  const auto pin = m.rigid_marker(slider, {0, 0, 0});
  hinge(Mechanism::ground({0, 0, 0}), hub, 0.010);
  m.add_joint(JointType::prescribed_rotation, Mechanism::ground({0, 0, 0}), hub, Vector3d::UnitZ(),
              base::TimeLaw::expression(base::Expression("150*t", {"t"}, {}, {})));
  hinge(m.rigid_marker(crank, {0.075, 0, 0}), m.node_marker(beam, 0), 0.008);
  hinge(m.node_marker(beam, rod.elements), pin, 0.008);
  m.add_joint(JointType::prismatic, Mechanism::ground({0.45, 0, 0}), pin, Vector3d::UnitX());
  if (rubs) {
    m.add_law(friction(1.0, 1e-5, Vector3d::UnitX()),
              JointCoordinate::displacement(Vector3d::UnitX(), Vector3d::Zero()));
  }
  return m.take();
}

struct Cost {
  long iterations = 0, solves = 0, allocations = 0;
};

/// Of half a turn, after the first steps.
Cost cost_of_steps(const model::Model& model) {
  const test::Start start = test::consistent_start(model);
  StepSettings settings;
  settings.step = 1e-4;
  Stepper stepper(model, settings, start.rows_in_use);
  model::State state = start.state;
  for (int k = 0; k < 10; ++k) stepper.step(state);
  const long before = stepper.counts(kRod).solves;
  Cost out;
  out.allocations = test::count_allocations([&] {
    for (int k = 0; k < 200; ++k) out.iterations += stepper.step(state).newton_iterations;
  });
  out.solves = stepper.counts(kRod).solves - before;
  return out;
}

TEST(FrictionInAllJoints, AddsFewIterationsAndNeitherSolvesNorMemory) {
  const Cost without = cost_of_steps(slider_crank(false));
  const Cost rubbing = cost_of_steps(slider_crank(true));
  // With slopes of the last step it would be a third more, as reactions turn within a step.
  EXPECT_LE(static_cast<double>(rubbing.iterations),
            1.15 * static_cast<double>(without.iterations));
  EXPECT_EQ(rubbing.solves, without.solves);
  if (test::kCountsAllocations) {
    EXPECT_EQ(rubbing.allocations, 0);
  }
}

TEST(FrictionInAllJoints, IsAccountedForWithoutMemory) {
  if (!test::kCountsAllocations) GTEST_SKIP() << "sanitizers have their own malloc";
  const model::Model model = slider_crank(true);
  const test::Start start = test::consistent_start(model);
  StepSettings settings;
  settings.step = 1e-4;
  Stepper stepper(model, settings, start.rows_in_use);
  model::State state = start.state;
  analysis::WorkAccount account(model, state, false);
  long allocations = 0;
  for (int k = 0; k < 60; ++k) {
    const StepReport report = stepper.step(state);
    ASSERT_NE(report.friction, nullptr);
    const long now = test::count_allocations([&] { account.add(state, nullptr, &report); });
    if (k >= 10) allocations += now;
  }
  EXPECT_EQ(allocations, 0);
  EXPECT_GT(account.work().dissipated, 0.0);
}

}  // namespace
}  // namespace buckens::stepping
