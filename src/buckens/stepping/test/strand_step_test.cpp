// SPDX-License-Identifier: Apache-2.0
// Mechanisms of small bodies step eight at a time as one by one.
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "buckens/linalg/simd_level.h"
#include "buckens/loads/applied_load.h"
#include "buckens/loads/distributed_load.h"
#include "buckens/loads/spring_damper.h"
#include "buckens/stepping/stepper.h"
#include "buckens/stepping/strand/step.h"
#include "buckens/stepping/test/row_of_rods.h"
#include "buckens/stepping/test/same_state.h"
#include "buckens/stepping/test/simulate.h"

namespace buckens::stepping {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using linalg::Vector;

std::vector<int> rows_of(const model::Model& model) {
  std::vector<int> out(static_cast<std::size_t>(model.num_constraint_rows()));
  std::iota(out.begin(), out.end(), 0);
  return out;
}

/// Links of 0.1 m on hinges whose axes alternate.
model::Model rigid_links(int count, std::optional<spatial::Plane> plane,
                         const std::function<void(test::Mechanism&)>& add = {}) {
  test::Mechanism m(plane);
  m.set_gravity({0, -9.81, 0});
  m.set_length(0.1 * count);
  int previous = -1;
  for (int k = 0; k < count; ++k) {
    const int link = test::add_rod(m, 1.0, 0.1, {{0.1 * k + 0.05, 0, 0}, Quaterniond::Identity()});
    const Vector3d axis = plane || k % 2 == 0 ? Vector3d::UnitZ() : Vector3d::UnitY();
    m.add_joint(
        joints::JointType::revolute,
        k == 0 ? test::Mechanism::ground({0, 0, 0}) : m.rigid_marker(previous, {0.05, 0, 0}),
        m.rigid_marker(link, {-0.05, 0, 0}), axis);
    previous = link;
  }
  if (add) add(m);
  return m.take();
}

/// Two rows of damped rods, at an angle, welded to the ends of a rigid bar on a ball joint.
model::Model rods_on_a_bar() {
  test::Mechanism m;
  m.set_gravity({0, -9.81, 0});
  m.set_length(0.2);
  test::BeamConstants rod = test::short_steel_rod();
  rod.alpha = 3.0;
  const int bar = test::add_rod(m, 0.5, 0.1, {{0, 0, 0}, Quaterniond::Identity()});
  for (const double side : {-1.0, 1.0}) {
    int previous = -1;
    for (int k = 0; k < 5; ++k) {
      const int body = m.add_flexible(test::straight_beam(rod), {},
                                      {{0.05 * side + k * rod.L, 0, 0}, Quaterniond::Identity()});
      m.add_joint(joints::JointType::fixed,
                  k == 0 ? m.rigid_marker(bar, {0.05 * side, 0, 0}) : m.node_marker(previous, 1),
                  m.node_marker(body, 0));
      previous = body;
    }
  }
  // The bar has two markers for joints; the ball joint is at the end of a row.
  m.add_joint(joints::JointType::spherical, test::Mechanism::ground({0.1, 0, 0}),
              m.node_marker(10, 1));
  return m.take();
}

using loads::AppliedLoad;
using loads::LoadAxes;

std::array<base::TimeLaw, 3> laws(const std::array<const char*, 3>& texts) {
  const auto law = [](const char* text) {
    return base::TimeLaw::expression(base::Expression(text, {"t"}, {}, {}));
  };
  return {law(texts[0]), law(texts[1]), law(texts[2])};
}

/// A following force at the end, a torque in the middle, and an even load on the third rod.
void load_rods(test::Mechanism& m, const std::vector<int>& rods, bool is_planar) {
  const model::MarkerId ground = test::Mechanism::ground({0, 0, 0});
  m.add_load(std::make_unique<AppliedLoad>(
                 AppliedLoad::Kind::force, LoadAxes::following,
                 laws({"20", "50 * sin(900 * t)", is_planar ? "0" : "10 - 3000 * t"})),
             m.node_marker(rods.back(), 1), ground);
  m.add_load(std::make_unique<AppliedLoad>(
                 AppliedLoad::Kind::torque, LoadAxes::fixed,
                 laws({is_planar ? "0" : "0.2", is_planar ? "0" : "-0.3", "cos(500 * t)"})),
             m.node_marker(rods[rods.size() / 2], 0), ground);
  m.add_load(std::make_unique<loads::DistributedLoad>(
                 LoadAxes::fixed, laws({"300", "-800", is_planar ? "0" : "500"}), 0.01),
             m.node_marker(rods[2], 1), ground);
}

/// Forces on links, at a joint, at the centre of mass and beside it.
void load_links(test::Mechanism& m, bool is_planar) {
  const model::MarkerId ground = test::Mechanism::ground({0, 0, 0});
  m.add_load(std::make_unique<AppliedLoad>(AppliedLoad::Kind::force, LoadAxes::following,
                                           laws({"0", "30", is_planar ? "0" : "5"})),
             m.rigid_marker(8, {0.05, 0, 0}), ground);
  m.add_load(std::make_unique<AppliedLoad>(AppliedLoad::Kind::torque, LoadAxes::fixed,
                                           laws({"0", "0", "sin(100 * t)"})),
             m.rigid_marker(4, {0, 0, 0}), ground);
  // Between two of them.
  m.add_load(std::make_unique<AppliedLoad>(AppliedLoad::Kind::force, LoadAxes::fixed,
                                           laws({"-10", "20 * t", "0"})),
             m.rigid_marker(3, {0.01, 0.02, 0}), m.rigid_marker(6, {0, 0, 0}));
}

struct Case {
  std::string name;
  std::function<model::Model()> make;
  Method method = Method::generalized_alpha;
  double step = 1e-4;
};

/// All bodies turn about the origin, in the plane about z only.
model::State turning(const model::Model& model) {
  model::State out = model::placed_state(model);
  const Vector3d w = model.planar ? Vector3d(0, 0, 3) : Vector3d(1, 2, 3);
  for (model::BodyState& s : out.bodies) {
    s.frame.w = s.frame.X_WB.q.conjugate() * w;
    s.frame.v = w.cross(s.frame.X_WB.p);
  }
  return out;
}

using linalg::SimdLevel;

StepSettings settings_of(const Case& of, bool side_by_side, SimdLevel simd) {
  StepSettings out;
  out.simd = simd;
  out.method = of.method;
  out.alpha = -0.1;
  out.step = of.step;
  out.side_by_side = side_by_side;
  return out;
}

double largest_difference(const Vector& a, const Vector& b) {
  return a.size() == 0 ? 0.0 : (a - b).cwiseAbs().maxCoeff();
}

class Strand : public testing::TestWithParam<std::tuple<Case, SimdLevel>> {
 protected:
  void SetUp() override {
    if (level() > linalg::best_simd_level()) GTEST_SKIP() << "not on this processor";
  }
  static const Case& mechanism() { return std::get<Case>(GetParam()); }
  static SimdLevel level() { return std::get<SimdLevel>(GetParam()); }
  static StepSettings settings(bool side_by_side) {
    return settings_of(mechanism(), side_by_side, level());
  }
};

TEST_P(Strand, StepsLikeTheGeneralRoute) {
  const model::Model model = mechanism().make();
  const StepSettings together = settings(true);
  Stepper fast(model, together, rows_of(model));
  Stepper slow(model, settings(false), rows_of(model));
  ASSERT_TRUE(fast.steps_side_by_side());
  ASSERT_FALSE(slow.steps_side_by_side());
  model::State a = turning(model);
  model::State b = a;
  const double h = together.step;
  const double L = model.length;
  for (int k = 0; k < 40; ++k) {
    const StepReport of_a = fast.step(a);
    const StepReport of_b = slow.step(b);
    ASSERT_TRUE(fast.steps_side_by_side());
    EXPECT_EQ(of_a.newton_iterations, of_b.newton_iterations) << k;
    EXPECT_EQ(of_a.large_solve_rounds, of_b.large_solve_rounds) << k;
    // Each step leaves up to 1e-15 L of positions open, and that over h of rates; stiff rods make
    // forces of it, which the method damps. Errors of all steps together stay below this many.
    constexpr double kSteps = 40;
    const double x = kSteps * 1e-14 * L;
    for (std::size_t i = 0; i < model.bodies.size(); ++i) {
      const model::BodyState& s = a.bodies[i];
      const model::BodyState& t = b.bodies[i];
      ASSERT_LE((s.frame.X_WB.p - t.frame.X_WB.p).norm(), x) << k << " " << i;
      ASSERT_LE((s.frame.X_WB.q.coeffs() - t.frame.X_WB.q.coeffs()).norm(), x / L) << k << " " << i;
      ASSERT_LE((s.frame.v - t.frame.v).norm(), x / h) << k << " " << i;
      ASSERT_LE(L * (s.frame.w - t.frame.w).norm(), x / h) << k << " " << i;
      ASSERT_LE(largest_difference(s.d, t.d), x) << k << " " << i;
      ASSERT_LE(largest_difference(s.d_dot, t.d_dot), x / h) << k << " " << i;
      ASSERT_LE(largest_difference(s.d_ddot, t.d_ddot), x / (h * h)) << k << " " << i;
    }
  }
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    EXPECT_EQ(fast.counts(i).solves, slow.counts(i).solves) << i;
    const model::Coupling& s = a.bodies[i].coupling;
    const model::Coupling& t = b.bodies[i].coupling;
    EXPECT_EQ(s.t, t.t);
    EXPECT_LE(largest_difference(s.load, t.load), 1e-6 * (1e-9 + t.load.norm())) << i;
    EXPECT_LE((s.moments.J - t.moments.J).norm(), 1e-6 * t.moments.J.norm()) << i;
    EXPECT_LE((s.moments.l_dot - t.moments.l_dot).norm(), 1e-6 * (1e-12 + t.moments.l_dot.norm()));
  }
}

TEST_P(Strand, DependsOnTheStateAlone) {
  const model::Model model = mechanism().make();
  Stepper stepper(model, settings(true), rows_of(model));
  model::State state = turning(model);
  for (int k = 0; k < 5; ++k) stepper.step(state);
  model::State once = state;
  stepper.step(once);
  stepper.step(once);
  StepSettings by_two_threads = settings(true);
  by_two_threads.threads = 2;
  Stepper other(model, by_two_threads, rows_of(model));
  model::State again = state;
  other.step(again);
  other.step(again);
  test::expect_same(once, again);
}

const Case kCases[] = {
    {"rods_in_the_plane", [] { return test::row_of_rods(13, spatial::Plane::xy); }},
    {"rods_in_space", [] { return test::row_of_rods(11, std::nullopt); }},
    {"rods_by_hht", [] { return test::row_of_rods(9, std::nullopt); }, Method::hht},
    {"links_in_the_plane", [] { return rigid_links(9, spatial::Plane::xy); }},
    {"links_in_space", [] { return rigid_links(20, std::nullopt); }, Method::generalized_alpha,
     1e-3},
    {"rods_on_a_bar", rods_on_a_bar},
    {"loads_in_the_plane",
     [] {
       return test::row_of_rods(13, spatial::Plane::xy, 1.0,
                                [](auto& m, const auto& rods) { load_rods(m, rods, true); });
     }},
    {"loads_in_space",
     [] {
       return test::row_of_rods(11, std::nullopt, 1.0,
                                [](auto& m, const auto& rods) { load_rods(m, rods, false); });
     }},
    {"loads_on_links_in_the_plane",
     [] { return rigid_links(9, spatial::Plane::xy, [](auto& m) { load_links(m, true); }); }},
    {"loads_on_links",
     [] { return rigid_links(20, std::nullopt, [](auto& m) { load_links(m, false); }); },
     Method::generalized_alpha, 1e-3}};

INSTANTIATE_TEST_SUITE_P(Of, Strand,
                         testing::Combine(testing::ValuesIn(kCases),
                                          testing::Values(SimdLevel::portable, SimdLevel::avx2,
                                                          SimdLevel::avx512)),
                         [](const auto& one) {
                           return std::get<Case>(one.param).name + "_" +
                                  linalg::to_string(std::get<SimdLevel>(one.param));
                         });

TEST(StrandStep, LeavesOtherMechanismsToTheGeneralRoute) {
  const auto steps_side_by_side = [](const model::Model& model, StepSettings settings = {}) {
    settings.step = 1e-4;
    return Stepper(model, settings, rows_of(model)).steps_side_by_side();
  };
  EXPECT_TRUE(steps_side_by_side(test::row_of_rods(8, spatial::Plane::xy)));
  EXPECT_FALSE(steps_side_by_side(test::row_of_rods(7, spatial::Plane::xy)));
  EXPECT_FALSE(steps_side_by_side(test::slider_crank(8)));
  EXPECT_FALSE(steps_side_by_side(test::planar_beam_pendulum(test::BeamConstants{})));
  StepSettings newmark;
  newmark.method = Method::newmark;
  EXPECT_FALSE(steps_side_by_side(test::row_of_rods(8, spatial::Plane::xy), newmark));
}

TEST(StrandStep, LeavesMechanismsWithAnythingElseToTheGeneralRoute) {
  using joints::JointType;
  const auto steps_side_by_side = [](const std::function<void(test::Mechanism&, int)>& change) {
    test::Mechanism m;
    m.set_gravity({0, -9.81, 0});
    int last = -1;
    for (int k = 0; k < 8; ++k) {
      const Vector3d place(0.1 * k, 0, 0);
      const int link = test::add_rod(m, 1.0, 0.1, {place, Quaterniond::Identity()});
      m.add_joint(JointType::revolute,
                  k == 0 ? test::Mechanism::ground(place) : m.rigid_marker(last, {0.05, 0, 0}),
                  m.rigid_marker(link, {k == 0 ? 0.0 : -0.05, 0, 0}));
      last = link;
    }
    change(m, last);
    const model::Model model = m.take();
    StepSettings settings;
    settings.step = 1e-4;
    return Stepper(model, settings, rows_of(model)).steps_side_by_side();
  };
  EXPECT_TRUE(steps_side_by_side([](test::Mechanism&, int) {}));
  EXPECT_TRUE(steps_side_by_side([](test::Mechanism& m, int) {
    m.add_coordinate(3, joints::JointCoordinate::Kind::angle);  // for sensors
  }));
  EXPECT_FALSE(steps_side_by_side([](test::Mechanism& m, int last) {
    m.add_load(std::make_unique<loads::SpringDamper>(0.0, 0.0, 1.0, std::nullopt),
               test::Mechanism::ground({0, 1, 0}), m.rigid_marker(last, {0, 0, 0}));
  }));
  // Rows of other kinds: lines, distances, laws of time and several coordinates.
  for (const JointType type : {JointType::point_on_line, JointType::distance,
                               JointType::constant_velocity, JointType::prismatic}) {
    EXPECT_FALSE(steps_side_by_side([&](test::Mechanism& m, int last) {
      m.add_joint(type, test::Mechanism::ground({0.8, 0.3, 0}), m.rigid_marker(last, {0.05, 0, 0}),
                  Vector3d::UnitY());
    })) << joints::to_string(type);
  }
  EXPECT_FALSE(steps_side_by_side([](test::Mechanism& m, int last) {
    m.add_joint(JointType::prescribed_rotation, test::Mechanism::ground({0, 0, 0}),
                m.rigid_marker(last, {0, 0, 0}), Vector3d::UnitZ(),
                base::TimeLaw::expression(base::Expression("t", {"t"}, {}, {})));
  }));
  // A third marker of a rigid body.
  EXPECT_FALSE(steps_side_by_side([](test::Mechanism& m, int) {
    m.add_joint(JointType::spherical, test::Mechanism::ground({0.3, 0.1, 0}),
                m.rigid_marker(3, {0, 0.1, 0}));
  }));
}

TEST(StrandStep, LeavesFastTurnsToTheGeneralRoute) {
  // Wheels on the ground, which turn by 1.5 rad in a step.
  test::Mechanism m(spatial::Plane::xy);
  for (int k = 0; k < 8; ++k) {
    const Vector3d place(k, 0, 0);
    const int wheel = test::add_rod(m, 1.0, 0.1, {place, Quaterniond::Identity()});
    m.add_joint(joints::JointType::revolute, test::Mechanism::ground(place),
                m.rigid_marker(wheel, {0, 0, 0}));
  }
  const model::Model model = m.take();
  StepSettings settings;
  settings.step = 0.05;
  Stepper fast(model, settings, rows_of(model));
  settings.side_by_side = false;
  Stepper slow(model, settings, rows_of(model));
  ASSERT_TRUE(fast.steps_side_by_side());
  model::State a = model::placed_state(model);
  for (model::BodyState& s : a.bodies) s.frame.w = {0, 0, 30};
  model::State b = a;
  fast.step(a);
  slow.step(b);
  test::expect_same(a, b);
  EXPECT_NEAR(2 * std::atan2(a.bodies[3].frame.X_WB.q.z(), a.bodies[3].frame.X_WB.q.w()), 1.5,
              1e-9);
}

}  // namespace
}  // namespace buckens::stepping
