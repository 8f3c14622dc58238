// SPDX-License-Identifier: Apache-2.0
// Steps of solids without a factor. Skipped where the multigrid solver is not built.
#include <array>
#include <memory>

#include <gtest/gtest.h>

#include "buckens/dynamics/test/mechanism.h"
#include "buckens/fem/assembly/assemble.h"
#include "buckens/fem/mesh/box_mesh.h"
#include "buckens/linalg/grid_library.h"
#include "buckens/linalg/iterative_solver.h"
#include "buckens/stepping/test/same_state.h"
#include "buckens/stepping/test/simulate.h"

namespace buckens::analysis {
namespace {

/// A soft block that swings on a ball joint at a corner.
model::Model swinging_block(fem::SolidKind kind, const std::array<int, 3>& divisions,
                            body::CouplingLevel level) {
  fem::Structure structure;
  fem::Box box;
  box.size = {0.3, 0.1, 0.1};
  box.divisions = divisions;
  fem::Material rubber = fem::Material::isotropic(2e7, 0.3, 1200);
  rubber.damping_stiffness = 1e-4;
  fem::add_box(structure, box, rubber, fem::SolidForm::usual(kind));
  test::Mechanism m;
  m.set_gravity({0, 0, -9.81});
  m.set_length(0.3);
  const int body = m.add_flexible(fem::assemble(structure), level, {});
  m.add_joint(joints::JointType::spherical, test::Mechanism::ground({0, 0, 0}),
              m.node_marker(body, 0));
  return m.take();
}

class IterativeStepTest : public testing::Test {
 protected:
  void SetUp() override {
    if (const std::string missing = linalg::missing_grid_solver(); !missing.empty()) {
      GTEST_SKIP() << "no multigrid solver: " << missing;
    }
  }

  /// Answers that are kept leave 1e-5 of a change of the coupling load, and how many are kept
  /// depends on the bytes of the solver: none here.
  static stepping::StepSettings with_factor() {
    stepping::StepSettings out;
    out.step = 1e-3;
    out.kept_solves = 0;
    return out;
  }

  static stepping::StepSettings without_factor(const model::Model& model, long* iterations) {
    stepping::StepSettings out = with_factor();
    out.make_factor = [&model, iterations](const linalg::MatrixSum& A) {
      linalg::IterationSettings settings;
      settings.block = 3;
      auto solver = std::make_shared<const linalg::IterativeSolver>(
          A, model.bodies[0].flexible->sieve.Phi(), settings);
      if (iterations == nullptr) return solver;
      return std::shared_ptr<const linalg::IterativeSolver>(
          solver.get(), [solver, iterations](const linalg::IterativeSolver* last) {
            *iterations = last->iteration_counts().iterations / last->iteration_counts().solves;
          });
    };
    return out;
  }

  /// 60 steps with and without a factor.
  static void expect_results_of_a_factor(const model::Model& model) {
    const test::Start start = test::consistent_start(model);
    const model::State expected = test::simulate(model, start, with_factor(), 60e-3);
    long iterations = 0;
    const model::State found =
        test::simulate(model, start, without_factor(model, &iterations), 60e-3);
    const model::BodyState& a = found.bodies[0];
    const model::BodyState& b = expected.bodies[0];
    // The promise: 1e-8 of the motion.
    EXPECT_LE((a.frame.X_WB.p - b.frame.X_WB.p).norm(), 1e-8 * b.frame.X_WB.p.norm());
    EXPECT_LE((a.frame.X_WB.q.coeffs() - b.frame.X_WB.q.coeffs()).norm(), 1e-8);
    EXPECT_LE((a.d.whole() - b.d.whole()).norm(), 1e-8 * b.d.norm());
    EXPECT_LE((a.d_dot.whole() - b.d_dot.whole()).norm(), 1e-8 * b.d_dot.norm());
    EXPECT_LE((found.lambda - expected.lambda).norm(), 1e-8 * expected.lambda.norm());
    EXPECT_GT(iterations, 0);
    EXPECT_LT(iterations, 40);
  }
};

TEST_F(IterativeStepTest, Hexahedra) {
  for (const auto level :
       {body::CouplingLevel::full, body::CouplingLevel::first_order, body::CouplingLevel::none}) {
    expect_results_of_a_factor(swinging_block(fem::SolidKind::hex8, {9, 3, 3}, level));
  }
}

TEST_F(IterativeStepTest, QuadraticTetrahedra) {
  expect_results_of_a_factor(
      swinging_block(fem::SolidKind::tet10, {4, 1, 1}, body::CouplingLevel::full));
}

/// The choice of a body, and that answers are kept for a factor only, which leave 1e-5 of changes.
TEST_F(IterativeStepTest, BodiesThatIterateKeepNoAnswers) {
  const model::Model model =
      swinging_block(fem::SolidKind::hex8, {12, 8, 8}, body::CouplingLevel::full);
  const test::Start start = test::consistent_start(model);
  const model::State expected = test::simulate(model, start, with_factor(), 20e-3);
  model.bodies[0].flexible->solver.kind = body::SolverKind::iterative;
  stepping::StepSettings settings = with_factor();
  const model::State none = test::simulate(model, start, settings, 20e-3);
  EXPECT_LE((none.bodies[0].d.whole() - expected.bodies[0].d.whole()).norm(),
            1e-8 * expected.bodies[0].d.norm());
  EXPECT_LE((none.lambda - expected.lambda).norm(), 1e-8 * expected.lambda.norm());
  settings.kept_solves = 80;
  test::expect_same(test::simulate(model, start, settings, 20e-3), none);
}

TEST_F(IterativeStepTest, TheNumberOfThreadsChangesNoBit) {
  const model::Model model =
      swinging_block(fem::SolidKind::hex8, {12, 8, 8}, body::CouplingLevel::full);
  const test::Start start = test::consistent_start(model);
  stepping::StepSettings settings = without_factor(model, nullptr);
  const model::State one = test::simulate(model, start, settings, 10e-3);
  settings.threads = 2;
  test::expect_same(test::simulate(model, start, settings, 10e-3), one);
}

}  // namespace
}  // namespace buckens::analysis
