// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/initial/position_assembly.h"

#include <gmock/gmock.h>

#include "buckens/analysis/test/static_models.h"
#include "buckens/base/errors.h"

namespace buckens::analysis::test {
namespace {

using testing::HasSubstr;

/// Crank 0.3, coupler `coupler`, rocker 0.5 over a base of 1, placed roughly.
Mechanism four_bar(double coupler, double misplaced) {
  Mechanism m;
  m.planar();
  m.rigid_rod("crank", 0.3, 1.0, {misplaced, -misplaced, 0}, 1.2);
  m.rigid_rod("coupler", coupler, 1.0, {0.1, 0.3 + misplaced, 0}, 0.2 - misplaced);
  m.rigid_rod("rocker", 0.5, 1.0, {1, 0, 0}, 1.5 + misplaced);
  m.joint<joints::RevoluteSpec>("a", at_marker("ground"), at_marker("crank/s"));
  m.joint<joints::RevoluteSpec>("b", at_marker("crank/e"), at_marker("coupler/s"));
  m.joint<joints::RevoluteSpec>("c", at_marker("coupler/e"), at_marker("rocker/e"));
  m.joint<joints::RevoluteSpec>("d", ground_at({1, 0, 0}), at_marker("rocker/s"));
  return m;
}

TEST(PositionAssembly, ClosesMisalignedPlacements) {
  for (const double misplaced : {0.0, 0.05, 0.2}) {
    SCOPED_TRACE(misplaced);
    const auto built = four_bar(0.9, misplaced).build();
    model::State state = model::placed_state(built->model);
    const dynamics::MassMetric metric(built->model);
    // The iteration stops at 1e-12 of the model's length.
    EXPECT_LE(assemble_positions(built->model, metric, state), 1e-11);
    EXPECT_NEAR(
        (place(built->model, state, "crank", "e") - place(built->model, state, "coupler", "s"))
            .norm(),
        0.0, 1e-11);
    EXPECT_NEAR(place(built->model, state, "crank", "e").norm(), 0.3, 1e-11);
  }
}

TEST(PositionAssembly, ClosesABodyTurnedOutOfItsHinge) {
  Mechanism m;
  m.rigid_rod("door", 1.0, 2.0, {0, 0, 0}, 0.5);
  m.joint<joints::RevoluteSpec>("low", at_marker("ground"), at_marker("door/s"));
  m.joint<joints::RevoluteSpec>("high", at_marker("ground"), at_marker("door/s"));
  const auto built = m.build();
  model::State state = model::placed_state(built->model);
  spatial::Pose& X = state.bodies[0].frame.X_WB;
  X.q = Eigen::Quaterniond(Eigen::AngleAxisd(0.2, Vector3d(1, 2, 0).normalized())) * X.q;
  X.p += Vector3d(0.1, -0.05, 0.07);
  const dynamics::MassMetric metric(built->model);
  EXPECT_LE(assemble_positions(built->model, metric, state), 1e-11);
  // The hinge axis is upright again.
  EXPECT_NEAR((X.q * Vector3d::UnitZ() - Vector3d::UnitZ()).norm(), 0.0, 1e-9);
}

TEST(PositionAssembly, ChangesAsLittleAsPossible) {
  // One body held at one point: translation of a placement error moves no more than the error.
  Mechanism m;
  m.rigid_rod("rod", 1.0, 1.0, {0.01, 0, 0});
  m.joint<joints::SphericalSpec>("ball", at_marker("ground"), at_marker("rod/s"));
  const auto built = m.build();
  model::State state = model::placed_state(built->model);
  const dynamics::MassMetric metric(built->model);
  assemble_positions(built->model, metric, state);
  EXPECT_NEAR(state.bodies[0].frame.X_WB.p.x(), 0.5, 1e-11);
  EXPECT_NEAR(state.bodies[0].frame.X_WB.q.vec().norm(), 0.0, 1e-11);
}

TEST(PositionAssembly, RefusesAnImpossibleFourBarWithItsGap) {
  // Crank 0.3 + coupler 0.1 + rocker 0.5 span at most 0.9 of the base of 1: 0.1 m are missing.
  const auto built = four_bar(0.1, 0.0).build();
  model::State state = model::placed_state(built->model);
  const dynamics::MassMetric metric(built->model);
  try {
    assemble_positions(built->model, metric, state);
    FAIL() << "assembled";
  } catch (const ModelError& error) {
    EXPECT_THAT(error.what(), HasSubstr("cannot be assembled"));
    EXPECT_THAT(error.what(), HasSubstr("joint \""));
    EXPECT_THAT(error.what(), HasSubstr("m apart"));
  }
  // The state is the closest approach: the gaps of all joints add up to the missing length.
  dynamics::Constraints constraints;
  dynamics::evaluate_constraints(built->model, dynamics::motions_of(built->model, state), 0.0,
                                 constraints);
  double gaps = 0.0;
  for (Eigen::Index k = 0; k < constraints.g.size(); k += 2) {
    gaps += constraints.g.segment<2>(k).norm();
  }
  EXPECT_NEAR(gaps, 0.1, 2e-3);
}

TEST(PositionAssembly, VelocitiesOfADrivenCrankFollow) {
  Mechanism m;
  m.planar();
  m.rigid_rod("crank", 0.3, 1.0);
  m.joint<joints::RevoluteSpec>("pivot", at_marker("ground"), at_marker("crank/s"));
  m.joint<joints::PrescribedRotationSpec>("drive", at_marker("ground"), at_marker("crank/s"))
      .angle = base::TimeLaw::table({0.0, 1.0}, {0.0, 5.0}, base::Interpolation::linear);
  const auto built = m.build();
  model::State state = model::placed_state(built->model);
  const dynamics::MassMetric metric(built->model);
  assemble_positions(built->model, metric, state);
  EXPECT_LE(project_velocities(built->model, metric, state), 1e-11);
  EXPECT_NEAR(state.bodies[0].frame.w.z(), 5.0, 1e-11);
  EXPECT_NEAR(state.bodies[0].frame.v.y(), 0.75, 1e-11);
}

}  // namespace
}  // namespace buckens::analysis::test
