// SPDX-License-Identifier: Apache-2.0
// Steps of bodies with many variables: threads, shared factors and memory.
#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/analysis/simulation/work_account.h"
#include "buckens/base/test/allocation_count.h"
#include "buckens/body/reduction.h"
#include "buckens/dynamics/test/mechanism.h"
#include "buckens/fem/mesh/box_mesh.h"
#include "buckens/stepping/stepper.h"

namespace buckens::verification::large_bodies {
namespace {

using body::CouplingLevel;
using stepping::Stepper;
using stepping::StepSettings;

fem::FeModel block(const std::array<int, 3>& divisions, double damping_stiffness = 0) {
  fem::Structure structure;
  fem::Box box;
  box.size = {1.0, 0.1, 0.1};
  box.divisions = divisions;
  fem::Material rubber = fem::Material::isotropic(1e8, 0.3, 1100);
  rubber.damping_mass = 0.3;
  rubber.damping_stiffness = damping_stiffness;
  fem::add_box(structure, box, rubber);
  return fem::assemble(structure);
}

/// Blocks along x, hinged at corners one to the next, the first to the ground.
model::Model chain(const std::vector<std::array<int, 3>>& divisions, CouplingLevel level) {
  test::Mechanism m;
  m.set_gravity({0, 0, -9.81});
  model::MarkerId last = test::Mechanism::ground({0, 0, 0});
  for (std::size_t k = 0; k < divisions.size(); ++k) {
    const int body =
        m.add_flexible(block(divisions[k], 1e-5), level,
                       {{static_cast<double>(k), 0, 0}, Eigen::Quaterniond::Identity()});
    m.add_joint(joints::JointType::spherical, last, m.node_marker(body, 0));
    last = m.node_marker(body, divisions[k][0]);
  }
  return m.take();
}

StepSettings settings(int threads) {
  StepSettings out;
  out.step = 1e-3;
  out.threads = threads;
  return out;
}

/// Equal to the last bit.
void expect_equal(const model::State& a, const model::State& b, const std::string& what) {
  EXPECT_EQ(a.lambda, b.lambda) << what;
  for (std::size_t k = 0; k < a.bodies.size(); ++k) {
    const model::BodyState& x = a.bodies[k];
    const model::BodyState& y = b.bodies[k];
    EXPECT_EQ(x.frame.X_WB.p, y.frame.X_WB.p) << what;
    EXPECT_EQ(x.frame.X_WB.q.coeffs(), y.frame.X_WB.q.coeffs()) << what;
    EXPECT_EQ(x.frame.w, y.frame.w) << what;
    EXPECT_EQ(x.d.whole(), y.d.whole()) << what;
    EXPECT_EQ(x.d_dot.whole(), y.d_dot.whole()) << what;
    EXPECT_EQ(x.d_ddot.whole(), y.d_ddot.whole()) << what;
    EXPECT_EQ(x.d_alg.whole(), y.d_alg.whole()) << what;
    EXPECT_EQ(x.coupling.load.whole(), y.coupling.load.whole()) << what;
  }
}

model::State after_steps(const model::Model& model, const test::Start& start, int threads) {
  Stepper stepper(model, settings(threads), start.rows_in_use);
  model::State state = start.state;
  for (int k = 0; k < 5; ++k) stepper.step(state);
  return state;
}

TEST(LargeBodies, MoveTheSameWithAnyNumberOfThreads) {
  // Two equal bodies and another one; then one whose factor is solved by two threads itself.
  const std::vector<std::vector<std::array<int, 3>>> cases = {{{40, 3, 3}, {40, 3, 3}, {30, 3, 3}},
                                                              {{60, 5, 5}}};
  for (const auto& divisions : cases) {
    for (const CouplingLevel level : {CouplingLevel::none, CouplingLevel::full}) {
      const model::Model model = chain(divisions, level);
      const test::Start start = test::consistent_start(model);
      const model::State alone = after_steps(model, start, 1);
      EXPECT_GT(alone.bodies[0].d.norm(), 0.0);
      for (const int threads : {2, 3}) {
        expect_equal(after_steps(model, start, threads), alone, std::to_string(threads));
      }
    }
  }
}

TEST(LargeBodies, EqualOnesShareOneFactorAndMoveAsAlone) {
  const auto make = [](int count) {
    test::Mechanism m;
    m.set_gravity({0, 0, -9.81});
    for (int k = 0; k < count; ++k) {
      const double y = k;
      const int body = m.add_flexible(block({40, 3, 3}, 1e-5), CouplingLevel::full,
                                      {{0, y, 0}, Eigen::Quaterniond::Identity()});
      m.add_joint(joints::JointType::spherical, test::Mechanism::ground({0, y, 0}),
                  m.node_marker(body, 0));
    }
    return m.take();
  };
  const model::Model one = make(1);
  const model::Model three = make(3);
  const test::Start start_one = test::consistent_start(one);
  const test::Start start_three = test::consistent_start(three);
  Stepper stepper(three, settings(1), start_three.rows_in_use);
  model::State together = start_three.state;
  for (int k = 0; k < 5; ++k) stepper.step(together);
  const model::State alone = after_steps(one, start_one, 1);
  long factorisations = 0;
  for (std::size_t b = 0; b < 3; ++b) {
    factorisations += stepper.counts(b).factorisations;
    // Several right-hand sides are summed in another order than one: rounding, times the condition
    // of the factor, over the whole motion.
    EXPECT_LE((together.bodies[b].d.whole() - alone.bodies[0].d.whole()).norm(),
              1e-9 * alone.bodies[0].d.norm());
  }
  EXPECT_EQ(factorisations, 1);
}

/// Allocations of any size in ten steps, once the coupling has its history.
long allocations_in_steps(const model::Model& model, const StepSettings& settings) {
  const test::Start start = test::consistent_start(model);
  Stepper stepper(model, settings, start.rows_in_use);
  model::State state = start.state;
  for (int k = 0; k < 8; ++k) stepper.step(state);
  return test::count_allocations([&] {
    for (int k = 0; k < 10; ++k) stepper.step(state);
  });
}

constexpr std::array<CouplingLevel, 3> kLevels = {CouplingLevel::none, CouplingLevel::first_order,
                                                  CouplingLevel::full};

TEST(LargeBodies, StepsAllocateNothing) {
  if (!test::kCountsAllocations) GTEST_SKIP() << "malloc belongs to a sanitizer";
  for (const CouplingLevel level : kLevels) {
    const model::Model model = chain({{20, 4, 4}, {20, 4, 4}, {12, 3, 3}}, level);
    for (const int threads : {1, 2}) {
      EXPECT_EQ(allocations_in_steps(model, settings(threads)), 0)
          << body::to_string(level) << ", " << threads;
    }
    for (const auto method :
         {stepping::Method::newmark, stepping::Method::hht, stepping::Method::wilson}) {
      StepSettings other = settings(1);
      other.method = method;
      EXPECT_EQ(allocations_in_steps(model, other), 0) << to_string(method);
    }
  }
}

TEST(LargeBodies, TheEnergyAccountOfADampedSolidAllocatesNothing) {
  if (!test::kCountsAllocations) GTEST_SKIP() << "malloc belongs to a sanitizer";
  const model::Model model = chain({{20, 4, 4}}, CouplingLevel::full);
  ASSERT_NE(model.bodies[0].flexible->nodal_motion, nullptr);
  const test::Start start = test::consistent_start(model);
  Stepper stepper(model, settings(1), start.rows_in_use);
  model::State state = start.state;
  analysis::WorkAccount account(model, state, false);
  long allocations = 0;
  for (int k = 0; k < 30; ++k) {
    const stepping::StepReport report = stepper.step(state);
    const long now = test::count_allocations([&] { account.add(state, nullptr, &report); });
    if (k >= 10) allocations += now;
  }
  EXPECT_EQ(allocations, 0);
  EXPECT_GT(account.work().dissipated, 0.0);
}

TEST(LargeBodies, StepsOfReducedBodiesAllocateNothing) {
  if (!test::kCountsAllocations) GTEST_SKIP() << "malloc belongs to a sanitizer";
  for (const CouplingLevel level : kLevels) {
    model::Model model = chain({{12, 2, 2}}, level);
    body::Body& body = model.bodies[0];
    body.flexible = body::reduce(
        body.name, *body.flexible,
        body::free_free_basis(body.name, *body.flexible, 8, true, body.length_scale()));
    EXPECT_EQ(allocations_in_steps(model, settings(1)), 0) << body::to_string(level);
  }
}

}  // namespace
}  // namespace buckens::verification::large_bodies
