// SPDX-License-Identifier: Apache-2.0
// What a run needs to continue: a copy of the state, and of the solves that were kept; see
// README.md.
#include <array>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/dynamics/test/example_models.h"
#include "buckens/fem/mesh/box_mesh.h"
#include "buckens/linalg/sparse_cholesky.h"
#include "buckens/stepping/test/same_state.h"
#include "buckens/stepping/test/simulate.h"

namespace buckens::verification::continuation {
namespace {

using stepping::Method;

/// Steps of two lengths in turn: five long ones, three short ones.
class Run {
 public:
  Run(const model::Model& model, stepping::StepSettings settings, const std::vector<int>& rows,
      model::State state)
      : state_(std::move(state)) {
    for (auto& stepper : steppers_) {
      stepper = std::make_unique<stepping::Stepper>(model, settings, rows);
      settings.step *= 0.5;
    }
  }

  void go(int rounds, bool changes_step) {
    for (int round = 0; round < rounds; ++round) {
      for (int k = 0; k < 5; ++k) steppers_[0]->step(state_);
      for (int k = 0; k < 3; ++k) steppers_[changes_step ? 1 : 0]->step(state_);
    }
  }
  /// Goes on with what the steppers of another run have kept.
  void take_kept_solves(Run& from) {
    for (std::size_t k = 0; k < steppers_.size(); ++k) {
      base::SavedValues saved;
      from.steppers_[k]->visit_saved(base::SaveVisit::saving(saved));
      steppers_[k]->visit_saved(base::SaveVisit::restoring(saved));
    }
  }
  const model::State& state() const { return state_; }

 private:
  std::array<std::unique_ptr<stepping::Stepper>, 2> steppers_;
  model::State state_;
};

/// Runs on from a copy with new steppers and compares with the run that was never interrupted.
void expect_same_bits(const model::Model& model, Method method, double h) {
  const test::Start start = test::consistent_start(model);
  stepping::StepSettings settings;
  settings.method = method;
  settings.step = h;
  for (const auto& [changes_step, keeps] : {std::pair(false, false), std::pair(true, false),
                                            std::pair(false, true), std::pair(true, true)}) {
    settings.kept_solves = keeps ? 80 : 0;
    Run through(model, settings, start.rows_in_use, start.state);
    through.go(8, changes_step);
    Run resumed(model, settings, start.rows_in_use, through.state());
    if (keeps) resumed.take_kept_solves(through);
    through.go(8, changes_step);
    resumed.go(8, changes_step);
    test::expect_same(through.state(), resumed.state());
  }
}

/// A beam in space whose elements have frames of their own, hinged at one end.
model::Model divided_beam(int elements) {
  test::Mechanism m;
  m.set_gravity({0, 0, -9.81});
  test::BeamConstants element;
  element.L = 1.0 / elements;
  element.elements = 1;
  model::MarkerId last = test::Mechanism::ground({0, 0, 0});
  for (int k = 0; k < elements; ++k) {
    const int body = m.add_flexible(test::straight_beam(element), body::CouplingLevel::full,
                                    {{k * element.L, 0, 0}, Eigen::Quaterniond::Identity()});
    m.add_joint(k == 0 ? joints::JointType::spherical : joints::JointType::fixed, last,
                m.node_marker(body, 0));
    last = m.node_marker(body, 1);
  }
  return m.take();
}

/// A block of solid elements on a ball joint at a corner; its factor is laid out in panels.
model::Model solid_block() {
  test::Mechanism m;
  m.set_gravity({0, 0, -9.81});
  fem::Structure structure;
  fem::Box box;
  box.size = {1.0, 0.1, 0.1};
  box.divisions = {12, 5, 5};
  fem::add_box(structure, box, fem::Material::isotropic(1e8, 0.3, 1100));
  const int body = m.add_flexible(fem::assemble(structure), body::CouplingLevel::full, {});
  m.add_joint(joints::JointType::spherical, test::Mechanism::ground({0, 0, 0}),
              m.node_marker(body, 0));
  return m.take();
}

TEST(Continuation, RigidDoublePendulum) {
  expect_same_bits(test::rigid_double_pendulum(false), Method::generalized_alpha, 1e-3);
}

TEST(Continuation, SliderCrankByEveryMethod) {
  for (const Method method :
       {Method::generalized_alpha, Method::newmark, Method::hht, Method::wilson}) {
    expect_same_bits(test::slider_crank(4), method, 5e-5);
  }
}

TEST(Continuation, SpatialBeamPendulum) {
  expect_same_bits(test::spatial_beam_pendulum({}), Method::generalized_alpha, 1e-4);
}

TEST(Continuation, BeamWithAFramePerElement) {
  expect_same_bits(divided_beam(5), Method::generalized_alpha, 1e-4);
}

TEST(Continuation, BlockOfSolids) {
  const model::Model model = solid_block();
  const stepping::Scheme scheme(Method::generalized_alpha, 1e-3, 0.9);
  const stepping::BodyStepOperator op(*model.bodies[0].flexible, scheme);
  const auto& factor = dynamic_cast<const linalg::SparseCholesky&>(*op.shared_factor());
  ASSERT_EQ(factor.route(), linalg::SolveRoute::panels);
  expect_same_bits(model, Method::generalized_alpha, 1e-3);
}

}  // namespace
}  // namespace buckens::verification::continuation
