// SPDX-License-Identifier: Apache-2.0
// A body of several frames in results and sensors.
#include "buckens/results/divided_body.h"

#include <gtest/gtest.h>

#include "buckens/results/test/recorded.h"
#include "buckens/spatial/rotation.h"

namespace buckens::results::test {
namespace {

using Eigen::Vector3d;
using model::test::Described;

/// Free beam of 1 m along x in three parts of two elements.
Described divided_beam() {
  Described m;
  m.beam("rod", Vector3d::Zero(), Vector3d::UnitX(), 6).frames = 3;
  m.sensor_of<model::DeflectionSensor>("sag", "rod/mid");
  m.sensor<model::StressSensor>("stress").of = model::test::at_marker("rod");
  m.sensor_of<model::PositionSensor>("tip", "rod/end");
  return m;
}

/// Turns and moves all parts together.
void move_rigidly(Recorded& r, const spatial::Pose& X) {
  for (model::BodyState& s : r.state.bodies) s.frame.X_WB = X * s.frame.X_WB;
}

const spatial::Pose kSomewhere{{3, -2, 1}, spatial::exp_rotation(Vector3d(0.5, -1.0, 2.0))};

TEST(DividedBody, LooksLikeOneBody) {
  Recorded r(divided_beam());
  r.record();
  const RecordLayout& layout = r.recorder.layout();
  EXPECT_GE(layout.find("bodies/rod/pose"), 0);
  EXPECT_LT(layout.find("bodies/rod[1]/pose"), 0);
  EXPECT_LT(layout.find("joints/rod[1-2]/force"), 0);
  EXPECT_EQ(r.values("bodies/rod/displacement").size(), 7 * 6);
  EXPECT_EQ(r.values("bodies/rod/section_force").size(), 6 * 12);
  EXPECT_EQ(r.values("bodies/rod/cut_force").size(), 2 * 6);
  const Geometry geometry = r.recorder.geometry();
  ASSERT_EQ(geometry.bodies.size(), 1U);
  EXPECT_EQ(geometry.bodies[0].nodes.rows(), 7);
  EXPECT_EQ(geometry.bodies[0].elements.size(), 6U);
  EXPECT_TRUE(geometry.joints.empty());
}

TEST(DividedBody, ARigidMotionDisplacesNothing) {
  Recorded r(divided_beam());
  move_rigidly(r, kSomewhere);
  r.record();
  const auto pose = r.values("bodies/rod/pose");
  EXPECT_LT((pose.head<3>() - kSomewhere * Vector3d(0.5, 0, 0)).norm(), 1e-14);
  EXPECT_LT(r.values("bodies/rod/displacement").norm(), 1e-13);
  EXPECT_LT(r.sensor("sag").norm(), 1e-13);
}

TEST(DividedBody, DeflectionIsMeasuredFromTheChordOfTheWhole) {
  // The middle part moves across by 1 cm, whatever the attitude.
  Recorded r(divided_beam());
  r.state.bodies[1].frame.X_WB.p.y() += 0.01;
  move_rigidly(r, kSomewhere);
  r.record();
  EXPECT_NEAR(r.sensor("sag")[1], 0.01, 1e-12);
  EXPECT_NEAR(r.sensor("sag")[0], 0.0, 1e-12);
}

TEST(DividedBody, ElementsOfAllPartsAreListedInTheOrderOfTheMesh) {
  Recorded r(divided_beam());
  // Stretch the first element of the third part: the fifth of the beam. N = EA u/l.
  const auto& part = r.built->model.bodies[2];
  const double shift = 1e-6;
  int node = 0;
  for (std::size_t n = 0; n < part.flexible->fe.nodes.size(); ++n) {
    if (part.flexible->fe.nodes[n].position.x() < 0.7) node = static_cast<int>(n);
  }
  r.body(2).d.change()[part.flexible->fe.dofs.node_dofs[static_cast<std::size_t>(node)][0]] =
      -shift;
  r.record();
  const auto forces = r.values("bodies/rod/section_force");
  const double expected = model::test::kE * model::test::kArea * shift * 6.0;
  for (int e = 0; e < 6; ++e) {
    EXPECT_NEAR(forces[12 * e], e == 4 ? expected : 0.0, 1e-9 * expected) << e;
  }
  EXPECT_NEAR(r.sensor("stress")[0], expected / model::test::kArea, 1e-9 * expected * 1e4)
      << "the largest of all parts";
}

TEST(DividedBody, CutForcesAreThoseOfTheTies) {
  Recorded r(divided_beam());
  // Rows of a weld: three of the point in the world, then directions. The multiplier acts on the
  // later part.
  r.state.lambda[0] = 5.0;
  const auto& ties = r.built->model.joints;
  ASSERT_EQ(ties.size(), 2U);
  r.state.lambda[ties[1].first_row + 1] = -2.0;
  r.record();
  const auto force = r.values("bodies/rod/cut_force");
  EXPECT_NEAR(force[0], 5.0, 1e-12);
  EXPECT_NEAR(force[6 + 1], -2.0, 1e-12);
}

}  // namespace
}  // namespace buckens::results::test
