// SPDX-License-Identifier: Apache-2.0
// Bodies carried by several frames: parts, ties, markers, messages.
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/model/build/mesh_division.h"
#include "buckens/model/state.h"
#include "buckens/model/test/described.h"
#include "buckens/spatial/rotation.h"

namespace buckens::model::test {
namespace {

using body::FrameDivision;

/// Pinned steel beam of 1 m along x.
Described pinned_beam(int elements, const FrameDivision& frames) {
  Described m;
  m.beam("rod", Vector3d::Zero(), Vector3d::UnitX(), elements).frames = frames;
  m.joint<joints::SphericalSpec>("pin", "ground", "rod/start");
  return m;
}

int count_ties(const Model& model) {
  int count = 0;
  for (const Joint& joint : model.joints) count += joint.is_tie ? 1 : 0;
  return count;
}

TEST(DividedBody, PartsCarryNamesMassAndFrames) {
  const auto built = pinned_beam(8, 4).build();
  const Model& model = built->model;
  ASSERT_EQ(model.bodies.size(), 4U);
  ASSERT_EQ(model.wholes.size(), 1U);
  const WholeBody& whole = model.wholes[0];
  EXPECT_TRUE(whole.is_divided());
  EXPECT_EQ(model.bodies[2].name, "rod[3]");
  EXPECT_EQ(model.whole_of(3), 0);
  double mass = 0;
  for (std::size_t b = 0; b < 4; ++b) {
    mass += model.bodies[b].mass;
    // Each quarter has its frame in its own middle.
    EXPECT_NEAR(model.placed[b].p.x(), 0.125 + 0.25 * static_cast<double>(b), 1e-14);
    EXPECT_EQ(model.bodies[b].num_dofs(), 18);
  }
  EXPECT_NEAR(mass, kRho * kArea, 1e-12);
  EXPECT_NEAR(whole.mass, mass, 1e-12);
  EXPECT_NEAR(whole.com.x(), 0.5, 1e-14);
  EXPECT_EQ(whole.nodes.size(), 9U);
  EXPECT_EQ(whole.lines.size(), 8U);
}

TEST(DividedBody, TiesFormASpanningTreePerCutNode) {
  const auto built = pinned_beam(4, FrameDivision::each_element()).build();
  EXPECT_EQ(built->model.bodies.size(), 4U);
  EXPECT_EQ(count_ties(built->model), 3);
  // Three welds of six rows, then the pin: ties come first so that joints count as redundant.
  EXPECT_EQ(built->model.num_constraint_rows(), 3 * 6 + 3);
  EXPECT_TRUE(built->model.joints.front().is_tie);
  EXPECT_EQ(built->model.joints.front().name, "rod[1-2]");
  EXPECT_EQ(built->model.joints.back().name, "pin");

  Described star;
  auto& body =
      star.truss("star", {{"c", {0, 0, 0}}, {"x", {1, 0, 0}}, {"y", {0, 1, 0}}, {"z", {0, 0, 1}}},
                 {{"c", "x"}, {"c", "y"}, {"c", "z"}});
  body.frames = FrameDivision::each_element();
  const auto branched = star.build();
  EXPECT_EQ(count_ties(branched->model), 2);  // three copies of c
  EXPECT_EQ(branched->model.num_constraint_rows(), 2 * 3);
}

TEST(DividedBody, BarsOfOneMemberHaveNoKink) {
  Described m;
  m.d.planar = spatial::Plane::xy;
  auto& body = m.truss("strut", {{"a", {0, 0, 0}}, {"b", {3, 4, 0}}}, {{"a", "b"}});
  std::get<fem::StructureSpec>(body.kind).bars[0].elements = 3;
  body.frames = FrameDivision::each_element();
  const auto built = m.build();
  ASSERT_EQ(built->model.bodies.size(), 3U);
  // Two rows for the point and one for the angle of the frames, twice.
  EXPECT_EQ(built->model.num_constraint_rows(), 2 * 3);

  m.d.planar.reset();
  EXPECT_EQ(m.build()->model.num_constraint_rows(), 2 * 5) << "in space: point and two angles";
}

TEST(DividedBody, BarsOfOneMemberInOneFrameAreAMechanism) {
  Described m;
  auto& body = m.truss("strut", {{"a", {0, 0, 0}}, {"b", {3, 4, 0}}}, {{"a", "b"}});
  std::get<fem::StructureSpec>(body.kind).bars[0].elements = 3;
  EXPECT_THROW(m.build(), InputError);
}

TEST(DividedBody, MarkersAreFoundOnThePartThatHoldsThem) {
  Described m = pinned_beam(8, 4);
  m.d.bodies[0].markers = {Described::marker("grip", {0.8, 0, 0})};
  m.force("push", "rod/end", {0, 0, 1});
  m.force("pull", "rod/grip", {0, 0, 1});
  m.sensor_of<PositionSensor>("mid", "rod/mid");
  m.sensor_of<PositionSensor>("com", "rod");
  const auto built = m.build();
  const Model& model = built->model;
  EXPECT_EQ(model.joints.back().second.body, 0);
  EXPECT_EQ(model.loads[0].first.body, 3);
  EXPECT_EQ(model.loads[1].first.body, 3);
  const MarkerId& mid = built->sensors[0].markers[0];
  EXPECT_EQ(mid.body, 1) << "a node at a cut belongs to the first part that has it";
  const auto& marker = model.bodies[1].markers[static_cast<std::size_t>(mid.marker)];
  EXPECT_NEAR((model.placed[1] * marker.X_BF).p.x(), 0.5, 1e-14);
  const MarkerId& com = built->sensors[1].markers[0];
  EXPECT_NEAR((model.placed[static_cast<std::size_t>(com.body)] *
               model.bodies[static_cast<std::size_t>(com.body)]
                   .markers[static_cast<std::size_t>(com.marker)]
                   .X_BF)
                  .p.x(),
              0.5, 1e-14)
      << "the mass centre is that of the whole";
}

TEST(DividedBody, PointMassesCountOnce) {
  Described m = pinned_beam(4, 2);
  std::get<fem::BeamSpec>(m.d.bodies[0].kind).masses = {{{}, "mid", 2.0, {}}};
  const auto built = m.build();
  EXPECT_NEAR(built->model.bodies[0].mass + built->model.bodies[1].mass, kRho * kArea + 2.0, 1e-12);
  EXPECT_NEAR(built->model.wholes[0].mass, kRho * kArea + 2.0, 1e-12);
}

TEST(DividedBody, SectionsAreThoseOfTheWholeBeam) {
  Described m = pinned_beam(6, 3);
  m.sensor<SectionForceSensor>("third");
  auto& sensor = std::get<SectionForceSensor>(m.d.output.sensors[0].kind);
  sensor.of = at_marker("rod");
  sensor.element = 4;
  const auto built = m.build();
  EXPECT_EQ(built->sensors[0].body, 1);
  EXPECT_EQ(built->sensors[0].element, 1) << "the fourth element is the second of the second part";
  std::get<SectionForceSensor>(m.d.output.sensors[0].kind).element = 7;
  try {
    m.build();
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("has 6 elements, not 7"), std::string::npos);
  }
}

TEST(DividedBody, TheFittedFrameFollowsARigidMotion) {
  const auto built = pinned_beam(6, 3).build();
  const Model& model = built->model;
  State state = placed_state(model);
  const spatial::Pose turn{{1, 2, 3}, spatial::exp_rotation(Vector3d(0.4, -1.1, 2.0))};
  const Vector3d w(0.3, -0.2, 0.5);
  for (std::size_t b = 0; b < 3; ++b) {
    body::FrameMotion& frame = state.bodies[b].frame;
    frame.w = w;
    frame.v = Vector3d(4, 5, 6) + turn.q * w.cross(frame.X_WB.p - Vector3d(0.5, 0, 0));
    frame.X_WB = turn * frame.X_WB;
  }
  const body::FrameMotion fitted = whole_motion(model, model.wholes[0], state);
  EXPECT_LT((fitted.X_WB.p - turn * Vector3d(0.5, 0, 0)).norm(), 1e-14);
  EXPECT_LT((fitted.X_WB.R() - turn.R()).norm(), 1e-13);
  EXPECT_LT((fitted.w - w).norm(), 1e-12);
  EXPECT_LT((fitted.v - Vector3d(4, 5, 6)).norm(), 1e-14);
}

TEST(DividedBody, CutsThatNeedTooMuchMemoryAreRefused) {
  // Two cubes side by side: four cut nodes, 12 rows and 24 variables in each part.
  NamedStructure bar;
  fem::Structure& s = bar.structure;
  for (int x = 0; x < 3; ++x) {
    for (const auto& [y, z] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
      fem::add_node(s, "", Vector3d(x, y, z));
    }
  }
  const int material = s.solids.add_material({kE, 0.3, kE / 2.6, kRho, 0, 0});
  s.solids.add({0, 4, 5, 1, 3, 7, 6, 2}, material);
  s.solids.add({4, 8, 9, 5, 7, 11, 10, 6}, material);
  const MeshDivision division = divide_mesh(bar, FrameDivision::each_element());
  ASSERT_EQ(division.parts.size(), 2U);
  const double bytes = 2 * 8.0 * (4 * 24 * 12 + 8 * 12 * 12);
  EXPECT_DOUBLE_EQ(predicted_bytes(division), bytes);
  EXPECT_NO_THROW(require_memory(division, bytes));
  try {
    require_memory(division, 0.5 * bytes);
    FAIL();
  } catch (const ModelError& error) {
    EXPECT_NE(std::string(error.what()).find("cut the mesh at 4 nodes"), std::string::npos);
  }
}

TEST(GeometricStiffness, IsSwitchedOnPerBodyAndNoted) {
  Described m = pinned_beam(4, 2);
  EXPECT_FALSE(m.build()->model.bodies[0].flexible->geometric);
  m.d.bodies[0].geometric_stiffness = true;
  const auto built = m.build();
  for (const body::Body& part : built->model.bodies) {
    EXPECT_TRUE(part.flexible->geometric);
    EXPECT_TRUE(part.flexible->coupling.terms.stiffening);
  }
  ASSERT_FALSE(built->model.notes.empty());
  EXPECT_NE(built->model.notes[0].find("conserves neither energy"), std::string::npos);
  m.d.bodies[0].coupling.level = body::CouplingLevel::automatic;
  EXPECT_THROW(m.build(), InputError);
}

TEST(DividedBody, MessagesNameTheBody) {
  const auto expect = [](Described& m, const char* words) {
    try {
      m.build();
      ADD_FAILURE() << words;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  Described many = pinned_beam(4, 5);
  expect(many, "body \"rod\": 5 frames for 4 elements");
  Described rigid;
  rigid.rigid("block", 1, Vector3d::Zero(), Vector3d::Ones()).frames = 2;
  expect(rigid, "bodies.block.frames: a rigid body has one frame");
  Described self = pinned_beam(4, 2);
  self.joint<joints::SphericalSpec>("loop", "rod/start", "rod/end");
  expect(self, "joints.loop.spherical.between: \"rod/start\" and \"rod/end\" are on the same body");
}

}  // namespace
}  // namespace buckens::model::test
