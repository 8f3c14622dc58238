// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/initial/prepare.h"

#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/model/test/described.h"

namespace buckens::analysis {
namespace {

using Eigen::Vector3d;
using model::test::Described;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// A built model and the metric that belongs to it.
struct Ready {
  std::unique_ptr<model::BuiltModel> built;
  dynamics::MassMetric metric;
  Prepared prepared;
  explicit Ready(const Described& m)
      : built(m.build()), metric(built->model), prepared(prepare(*built, metric)) {}
  const model::BodyState& body(std::size_t b = 0) const { return prepared.state.bodies[b]; }
};

/// Block with its pin 1 m beside the mass centre.
Described hinged_block() {
  Described m;
  m.d.gravity = {0, -10, 0};
  m.rigid("block", 2, {1, 0, 0}, {2, 2, 3}).markers = {Described::marker("pin", {0, 0, 0})};
  m.joint<joints::RevoluteSpec>("hinge", "ground", "block/pin").axis = Vector3d::UnitZ();
  return m;
}

model::InitialBodySpec motion(const std::string& body, const Vector3d& v, const Vector3d& w) {
  model::InitialBodySpec out;
  out.name = body;
  out.where = model::test::at_line(80);
  out.velocity = v;
  out.angular_velocity = w;
  return out;
}

TEST(Prepare, AccelerationsAreThoseOfTheReleasedPendulum) {
  const Ready ready(hinged_block());
  // φ¨ = −m g l / (J + m l²) = −20/5.
  EXPECT_NEAR((ready.body().w_dot - Vector3d(0, 0, -4)).norm(), 0, 1e-10);
  EXPECT_NEAR((ready.body().v_dot - Vector3d(0, -4, 0)).norm(), 0, 1e-10);
  EXPECT_EQ(ready.prepared.rows_in_use.size(), 5U);
  EXPECT_TRUE(ready.prepared.redundant_rows.empty());
}

TEST(Prepare, VelocitiesAreProjectedByTheLeastChange) {
  Described m = hinged_block();
  m.d.initial.bodies = {motion("block", {0, 5, 3}, {0, 0, 0})};
  const Ready ready(m);
  // The hinge leaves the angular momentum about it: m l v / (J + m l²) = 10/5; v_z is lost.
  EXPECT_NEAR((ready.body().frame.w - Vector3d(0, 0, 2)).norm(), 0, 1e-10);
  EXPECT_NEAR((ready.body().frame.v - Vector3d(0, 2, 0)).norm(), 0, 1e-10);
  // A warning is given.
  ASSERT_FALSE(ready.prepared.notes.empty());
  EXPECT_THAT(ready.prepared.notes.back(),
              AllOf(HasSubstr("body \"block\""), HasSubstr("by (0, -3, -3) to (0, 2, 0) m/s"),
                    HasSubstr("(0, 0, 2) rad/s")));
}

TEST(Prepare, VelocitiesThatFitTheJointsPassWithoutAWord) {
  Described m = hinged_block();
  m.d.initial.bodies = {motion("block", {0, 2, 0}, {0, 0, 2})};
  const Ready ready(m);
  for (const std::string& note : ready.prepared.notes) {
    EXPECT_THAT(note, testing::Not(HasSubstr("velocity")));
  }
}

TEST(Prepare, GapsAreClosed) {
  Described m = hinged_block();
  m.d.bodies[0].at.position = {0.01, -0.02, 0.005};
  const Ready ready(m);
  const spatial::Pose& X = ready.body().frame.X_WB;
  EXPECT_NEAR((X * Vector3d(-1, 0, 0)).norm(), 0, 1e-9);
}

TEST(Prepare, RedundantJointsAreNamed) {
  Described m = hinged_block();
  m.d.bodies[0].markers.push_back(Described::marker("second", {0, 0, 1}));
  auto& again = m.joint<joints::RevoluteSpec>("again", "ground", "block/second");
  again.between[0].point = Vector3d(0, 0, 1);
  again.axis = Vector3d::UnitZ();
  const Ready ready(m);
  EXPECT_EQ(ready.prepared.rows_in_use.size(), 5U);
  EXPECT_EQ(ready.prepared.redundant_rows.size(), 5U);
  ASSERT_FALSE(ready.prepared.redundant_text.empty());
  EXPECT_THAT(ready.prepared.redundant_text.back(), HasSubstr("follow from other joints"));
  EXPECT_NEAR((ready.body().w_dot - Vector3d(0, 0, -4)).norm(), 0, 1e-9);
}

TEST(Prepare, NodalVelocitiesAreSieved) {
  Described m;
  m.beam("rod", {0, 0, 0}, {2, 0, 0}, 4);
  model::InitialBodySpec initial = motion("rod", {0, 0, 0}, {0, 0, 0});
  initial.nodal_velocity.emplace();
  // A rigid motion 3 + 0.5 (x − 1) and a stretching 0.1 (x − 1): only the latter remains.
  initial.nodal_velocity->x = {base::Expression("0.1*(x - 1)", {"x", "y", "z"}, {}, {}), 1, true};
  initial.nodal_velocity->y = {base::Expression("3 + 0.5*(x-1)", {"x", "y", "z"}, {}, {}), 1, true};
  initial.nodal_velocity->rz = {base::Expression("0.5", {"x", "y", "z"}, {}, {}), 1, true};
  m.d.initial.bodies = {initial};
  const Ready ready(m);
  const fem::FeModel& fe = ready.built->model.bodies[0].flexible->fe;
  for (std::size_t n = 0; n < fe.nodes.size(); ++n) {
    const auto& dofs = fe.dofs.node_dofs[n];
    EXPECT_NEAR(ready.body().d_dot[dofs[0]], 0.1 * (fe.nodes[n].position.x() - 1), 1e-13);
    EXPECT_NEAR(ready.body().d_dot[dofs[1]], 0, 1e-12);
    EXPECT_NEAR(ready.body().d_dot[dofs[5]], 0, 1e-12);
  }
}

TEST(Prepare, MistakesInInitialAreNamed) {
  Described m = hinged_block();
  m.d.initial.bodies = {motion("blok", {1, 0, 0}, {0, 0, 0})};
  EXPECT_THAT([&] { Ready ready(m); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("test.yaml:80:1"), HasSubstr("\"blok\""))));
  m.d.initial.bodies[0].name = "block";
  m.d.initial.bodies[0].nodal_velocity.emplace();
  EXPECT_THAT([&] { Ready ready(m); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("\"block\""), HasSubstr("rigid"))));
}

TEST(Prepare, AStaticStartIsAtRest) {
  Described m;
  m.d.gravity = {0, -10, 0};
  m.beam("rod", {0, 0, 0}, {1, 0, 0}, 4);
  m.joint<joints::FixedSpec>("wall", "ground", "rod/start");
  m.d.initial.start = model::StartKind::static_equilibrium;
  const Ready ready(m);
  EXPECT_EQ(ready.prepared.setup_factorisations, 1);
  EXPECT_EQ(ready.body().d_dot.norm(), 0);
  // Unbalanced forces of 1e-9 of the weight move a node by no more than that over its mass.
  EXPECT_LT(ready.body().v_dot.norm(), 1e-5);
  EXPECT_GT(ready.body().d.norm(), 0);
}

}  // namespace
}  // namespace buckens::analysis
