// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gmock/gmock.h>

#include "buckens/analysis/statics/equilibrium.h"
#include "buckens/analysis/test/static_models.h"
#include "buckens/base/errors.h"

namespace buckens::analysis::test {
namespace {

using testing::Contains;
using testing::HasSubstr;

constexpr double kG = 9.81;
// Frames and meshes stand still to 1e-8 of gravity: the bound on force residuals (1e-9 of the
// largest force) and rounding of K d (1e-16 |K| |d| over the mass of one element) leave that much.
constexpr double kRest = 1e-8 * kG;

struct Solved {
  std::unique_ptr<model::BuiltModel> built;
  model::State state;
  StaticReport report;
  const model::Model& model() const { return built->model; }
  Vector3d at(const std::string& body, const std::string& marker) const {
    return place(model(), state, body, marker);
  }
};

Solved solve(const Mechanism& mechanism) {
  Solved out;
  out.built = mechanism.build();
  out.state = model::placed_state(out.model());
  out.report = find_static_equilibrium(out.model(), out.state);
  EXPECT_LE(out.report.force_residual, 1e-9 * out.report.largest_force);
  EXPECT_LE(out.report.position_residual, 1e-10);
  EXPECT_LE(largest_acceleration(out.model(), out.state), kRest);
  return out;
}

// Small deflections: the frame turns by about 0.3 w/L, and leaves terms of second order in it.
constexpr double kSecondOrder = 1e-4;

TEST(StaticEquilibrium, CantileverSagsUnderItsWeight) {
  for (const bool planar : {true, false}) {
    SCOPED_TRACE(planar);
    Mechanism m;
    if (planar) m.planar();
    m.beam("beam", 1.0, 8);
    m.joint<joints::FixedSpec>("clamp", at_marker("ground"), at_marker("beam/start"));
    m.force("beam/end", Vector3d::Zero());  // a marker to look at
    const Solved s = solve(m);
    const double deflection = -kRhoA * kG / (8 * kE * kIz);
    EXPECT_NEAR(s.at("beam", "end").y() / deflection, 1.0, kSecondOrder);
    EXPECT_EQ(s.report.factorisations, 1);
    EXPECT_LT(s.report.iterations, 30);
    // Clamp forces: the second marker is held up by λ along y.
    EXPECT_NEAR(s.state.lambda[1], kRhoA * kG, 1e-8 * kRhoA * kG);
  }
}

TEST(StaticEquilibrium, CantileverWithEndForceAndEndMoment) {
  const double F = 5.0;
  const double M = 4.0;
  for (const bool with_moment : {false, true}) {
    SCOPED_TRACE(with_moment);
    Mechanism m({0, 0, 0});
    m.beam("beam", 1.0, 4);
    m.joint<joints::FixedSpec>("clamp", at_marker("ground"), at_marker("beam/start"));
    if (with_moment) {
      m.torque("beam/end", {0, 0, M});
    } else {
      m.force("beam/end", {0, F, 0});
    }
    const Solved s = solve(m);
    const double deflection = with_moment ? M / (2 * kE * kIz) : F / (3 * kE * kIz);
    EXPECT_NEAR(s.at("beam", "end").y() / deflection, 1.0, kSecondOrder);
    EXPECT_NEAR(s.at("beam", "end").z(), 0.0, 1e-12);
  }
}

TEST(StaticEquilibrium, HorizontalPendulumsHangDown) {
  for (const bool planar : {true, false}) {
    SCOPED_TRACE(planar);
    Mechanism m;
    if (planar) m.planar();
    m.rigid_rod("upper", 1.0, 2.0);
    m.rigid_rod("lower", 0.7, 1.0, {1, 0, 0});
    m.joint<joints::RevoluteSpec>("pivot", at_marker("ground"), at_marker("upper/s"));
    m.joint<joints::RevoluteSpec>("elbow", at_marker("upper/e"), at_marker("lower/s"));
    const Solved s = solve(m);
    EXPECT_NEAR((s.at("lower", "e") - Vector3d(0, -1.7, 0)).norm(), 0.0, 1e-8);
    ASSERT_TRUE(s.report.lowest_stiffness.has_value());
    EXPECT_GT(*s.report.lowest_stiffness, 1.0);
  }
}

TEST(StaticEquilibrium, PendulumStandingUprightFallsOver) {
  Mechanism m;
  m.rigid_rod("rod", 1.0, 2.0, {0, 0, 0}, M_PI / 2);
  m.joint<joints::RevoluteSpec>("pivot", at_marker("ground"), at_marker("rod/s"));
  const Solved s = solve(m);
  EXPECT_NEAR((s.at("rod", "e") - Vector3d(0, -1, 0)).norm(), 0.0, 1e-8);
  // Compound pendulum: ω² = m g (l/2) / (m l²/3); the frame's κ counts the rotation about the pivot
  // with the same inertia.
  EXPECT_NEAR(*s.report.lowest_stiffness, 1.5 * kG, 1e-5 * kG);
}

TEST(StaticEquilibrium, FlexiblePendulumHangsAndStretches) {
  Mechanism m;
  m.beam("rod", 1.0, 4, {0, 0, 0}, 0.3);
  m.joint<joints::RevoluteSpec>("pivot", at_marker("ground"), at_marker("rod/start"));
  m.force("rod/end", Vector3d::Zero());
  const Solved s = solve(m);
  const Vector3d end = s.at("rod", "end");
  // Elongation under its own weight, w L²/(2 E A) = 1.9e-7 m; places are good to 1e-15 m.
  const double elongation = kRhoA * kG / (2 * kE * kArea);
  EXPECT_NEAR((-end.y() - 1.0) / elongation, 1.0, 1e-6);
  EXPECT_NEAR(end.x(), 0.0, 1e-9);
}

TEST(StaticEquilibrium, BeamOnTwoSprings) {
  Mechanism m;
  m.planar();
  m.beam("beam", 1.0, 4);
  for (const bool at_end : {false, true}) {
    auto& bushing = m.joint<joints::BushingSpec>(at_end ? "right" : "left",
                                                 ground_at({at_end ? 1.0 : 0.0, 0, 0}),
                                                 at_marker(at_end ? "beam/end" : "beam/start"));
    bushing.stiffness = {1e4, at_end ? 2e4 : 1e4, 1e4};
  }
  m.force("beam/mid", Vector3d::Zero());
  const Solved s = solve(m);
  const double weight = kRhoA * kG;
  // Ends turn by w L³/24EI = 1e-3 rad only: second-order terms stay below 1e-5 relative.
  EXPECT_NEAR(s.at("beam", "start").y() / (-weight / 2 / 1e4), 1.0, 1e-5);
  EXPECT_NEAR(s.at("beam", "end").y() / (-weight / 2 / 2e4), 1.0, 1e-5);
  const double mean = (s.at("beam", "start").y() + s.at("beam", "end").y()) / 2;
  EXPECT_NEAR((s.at("beam", "mid").y() - mean) / (-5 * weight / (384 * kE * kIz)), 1.0, 1e-3);
}

TEST(StaticEquilibrium, FourBarTurnsToTheAngleItsSpringAsksFor) {
  // A parallelogram of massless loads: a torsional spring at the crank, free angle 40 degrees.
  Mechanism m({0, 0, 0});
  m.planar();
  m.rigid_rod("crank", 0.5, 1.0, {0, 0, 0}, M_PI / 2);
  m.rigid_rod("coupler", 1.0, 1.0, {0, 0.5, 0}, 0.0);
  m.rigid_rod("rocker", 0.5, 1.0, {1, 0, 0}, M_PI / 2);
  m.joint<joints::RevoluteSpec>("a", at_marker("ground"), at_marker("crank/s"));
  m.joint<joints::RevoluteSpec>("b", at_marker("crank/e"), at_marker("coupler/s"));
  m.joint<joints::RevoluteSpec>("c", at_marker("coupler/e"), at_marker("rocker/e"));
  m.joint<joints::RevoluteSpec>("d", ground_at({1, 0, 0}), at_marker("rocker/s"));
  auto& spring = m.load<loads::TorsionalSpringSpec>("spring");
  spring.between = {at_marker("ground"), at_marker("crank")};
  spring.stiffness = 20.0;
  spring.angle = 40.0 * M_PI / 180;
  const Solved s = solve(m);
  const double angle = 130.0 * M_PI / 180;
  const Vector3d expected(0.5 * std::cos(angle), 0.5 * std::sin(angle), 0);
  EXPECT_NEAR((s.at("crank", "e") - expected).norm(), 0.0, 1e-9);
  EXPECT_NEAR((s.at("rocker", "e") - expected - Vector3d(1, 0, 0)).norm(), 0.0, 1e-9);
}

TEST(StaticEquilibrium, BarLongerThanItsGapIsPreloaded) {
  const double gap = 1e-4;
  Mechanism m({0, 0, 0});
  m.planar();
  m.beam("bar", 1.0, 4);
  m.joint<joints::FixedSpec>("left", at_marker("ground"), at_marker("bar/start"));
  m.joint<joints::FixedSpec>("right", ground_at({1.0 - gap, 0, 0}), at_marker("bar/end"));
  const Solved s = solve(m);
  // N = E A Δ / L: pushes the bar's end to the left, λ acts on the second marker.
  EXPECT_NEAR(s.state.lambda[3] / (-kE * kArea * gap), 1.0, 1e-9);
  EXPECT_NEAR(s.state.lambda[0] / (kE * kArea * gap), 1.0, 1e-9);
  EXPECT_NEAR(s.at("bar", "end").x(), 1.0 - gap, 1e-13);
}

TEST(StaticEquilibrium, TrussOfOneStructureUnderAForce) {
  // Two bars at ±45 degrees meet at the loaded node: u = F L / (2 E A sin²45°), sin² = 1/2.
  const double A = 1e-4;
  const double F = 1000.0;
  Mechanism m({0, 0, 0});
  m.planar();
  body::BodySpec& spec = m.add("truss", {0, 0, 0}, 0.0);
  fem::StructureSpec truss;
  for (const auto& [name, p] : std::initializer_list<std::pair<const char*, Vector3d>>{
           {"a", {0, 0, 0}}, {"b", {2, 0, 0}}, {"c", {1, 1, 0}}}) {
    fem::NodeSpec node;
    node.name = name;
    node.position = p;
    truss.nodes.push_back(node);
  }
  for (const auto& ends : {std::array<std::string, 2>{"a", "c"}, {"c", "b"}, {"a", "b"}}) {
    fem::BarMemberSpec bar;
    bar.between = ends;
    bar.area = A;
    bar.material.value.E = kE;
    bar.material.value.rho = 7800;
    truss.bars.push_back(bar);
  }
  spec.kind = truss;
  m.joint<joints::SphericalSpec>("left", at_marker("ground"), at_marker("truss/a"));
  m.joint<joints::SphericalSpec>("right", ground_at({2, 0, 0}), at_marker("truss/b"));
  m.force("truss/c", {0, -F, 0});
  const Solved s = solve(m);
  const double u = F * std::sqrt(2.0) / (kE * A);
  EXPECT_NEAR((1.0 - s.at("truss", "c").y()) / u, 1.0, 1e-3);
  // Statically determinate at c: each support carries half.
  EXPECT_NEAR(s.state.lambda[1], F / 2, 1e-3 * F);
}

TEST(StaticEquilibrium, DoorOnTwoHingesStaysWhereItIs) {
  Mechanism m({0, 0, -kG});
  m.rigid_rod("door", 1.0, 10.0);
  m.joint<joints::RevoluteSpec>("low", at_marker("ground"), at_marker("door/s"));
  m.joint<joints::RevoluteSpec>("high", at_marker("ground"),
                                at_marker("door/s"));  // same place: redundant
  const Solved s = solve(m);
  EXPECT_NEAR((s.at("door", "e") - Vector3d(1, 0, 0)).norm(), 0.0, 1e-7);
  EXPECT_THAT(s.report.notes, Contains(HasSubstr("without any restoring force")));
}

TEST(StaticEquilibrium, ChainOfManyBodiesUsesFewColours) {
  Mechanism m;
  m.planar();
  const int count = 60;
  for (int k = 0; k < count; ++k) {
    m.rigid_rod("link" + std::to_string(k), 0.1, 0.2, {0.1 * k, 0, 0});
    m.joint<joints::RevoluteSpec>(
        "pin" + std::to_string(k),
        k == 0 ? at_marker("ground") : at_marker("link" + std::to_string(k - 1) + "/e"),
        at_marker("link" + std::to_string(k) + "/s"));
  }
  const Solved s = solve(m);
  EXPECT_NEAR(s.at("link59", "e").y(), -6.0, 1e-7);
}

TEST(StaticEquilibrium, LawsOfTimeAreTakenAtTheInstant) {
  Mechanism m({0, 0, 0});
  m.beam("beam", 1.0, 4);
  m.joint<joints::FixedSpec>("clamp", at_marker("ground"), at_marker("beam/start"));
  auto& force = m.load<loads::ForceSpec>("pull");
  force.on = at_marker("beam/end");
  force.value = constant_law({0, 0, 0});
  force.value[1] = base::TimeLaw::table({0.0, 2.0}, {0.0, 10.0}, base::Interpolation::linear);
  const auto built = m.build();
  model::State state = model::placed_state(built->model);
  state.t = 1.0;
  const StaticReport report = find_static_equilibrium(built->model, state);
  EXPECT_THAT(report.notes, Contains(HasSubstr("\"pull\" varies with time")));
  EXPECT_NEAR(place(built->model, state, "beam", "end").y() / (5.0 / (3 * kE * kIz)), 1.0,
              kSecondOrder);
}

TEST(StaticEquilibrium, WeightOnARodBetweenFlexibleBeams) {
  // A pendulum hangs on the tip of a cantilever: its weight acts there, wherever it starts.
  Mechanism m;
  m.beam("beam", 1.0, 4);
  m.rigid_rod("weight", 0.5, 2.0, {1, 0, 0}, 0.4);
  m.joint<joints::FixedSpec>("clamp", at_marker("ground"), at_marker("beam/start"));
  m.joint<joints::RevoluteSpec>("hook", at_marker("beam/end"), at_marker("weight/s"));
  const Solved s = solve(m);
  const double deflection = -(2.0 * kG / (3 * kE * kIz) + kRhoA * kG / (8 * kE * kIz));
  EXPECT_NEAR(s.at("beam", "end").y() / deflection, 1.0, 3e-4);  // tip turns by 0.01 rad
  EXPECT_NEAR((s.at("weight", "e") - s.at("beam", "end") - Vector3d(0, -0.5, 0)).norm(), 0.0, 1e-8);
}

std::string refusal(const Mechanism& m) {
  const auto built = m.build();
  model::State state = model::placed_state(built->model);
  try {
    find_static_equilibrium(built->model, state);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "not refused";
}

TEST(StaticEquilibrium, BodyWithoutSupportIsRefused) {
  Mechanism rigid;
  rigid.rigid_rod("stone", 1.0, 1.0);
  EXPECT_THAT(refusal(rigid), HasSubstr("body \"stone\" moves along (0, -1, 0)"));
  Mechanism flexible;
  flexible.beam("arrow", 1.0, 2);
  EXPECT_THAT(refusal(flexible), HasSubstr("body \"arrow\" moves along (0, -1, 0)"));
}

TEST(StaticEquilibrium, CrankDrivenByAConstantTorqueIsRefused) {
  Mechanism m;
  m.rigid_rod("crank", 1.0, 1.0);
  m.joint<joints::RevoluteSpec>("pivot", at_marker("ground"), at_marker("crank/s"));
  m.torque("crank", {0, 0, 6.0});  // more than m g l/2 = 4.9 N m
  const std::string message = refusal(m);
  EXPECT_THAT(message, HasSubstr("body \"crank\" turns about (0, 0, 1)"));
  EXPECT_THAT(message, HasSubstr("start `as-given`"));
}

TEST(StaticEquilibrium, SlidingBlockOnAnInclineIsRefused) {
  Mechanism m;
  m.rigid_rod("block", 0.2, 1.0);
  m.joint<joints::PrismaticSpec>("rail", at_marker("ground"), at_marker("block/s")).axis = {3, 4,
                                                                                            0};
  EXPECT_THAT(refusal(m), HasSubstr("body \"block\" moves along (-0.6, -0.8, 0)"));
}

}  // namespace
}  // namespace buckens::analysis::test
