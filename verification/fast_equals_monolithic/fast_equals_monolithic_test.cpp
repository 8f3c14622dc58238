// SPDX-License-Identifier: Apache-2.0
// The condensed step and the monolithic saddle-point step end in the same states; see README.md.
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "verification/fast_equals_monolithic/same_steps.h"

#include "buckens/dynamics/test/example_models.h"
#include "buckens/loads/bushing.h"
#include "buckens/loads/coordinate_law.h"
#include "buckens/loads/joint_friction.h"
#include "buckens/loads/rigid_law.h"

namespace buckens::verification::fast_equals_monolithic {
namespace {

using Eigen::Vector3d;
using linalg::Vector;
using stepping::Method;
using test::Start;

constexpr int kSteps = 200;
TEST(FastEqualsMonolithic, PlanarFlexiblePendulum) {
  const model::Model model = test::planar_beam_pendulum(test::BeamConstants{});
  const Start start = test::consistent_start(model);
  for (const Method method : kMethods) {
    expect_same(model, start, tight(method, 1e-3));
  }
}

TEST(FastEqualsMonolithic, SpinningDampedBeamOnSphericalJoint) {
  const model::Model model = test::spatial_beam_pendulum(soft_damped_beam());
  const Start start = test::consistent_start(model, [](model::State& state) {
    body::FrameMotion& frame = state.bodies[0].frame;
    frame.w << 3, -1, 4;
    frame.v = frame.w.cross(frame.X_WB.p);
  });
  for (const Method method : kMethods) {
    expect_same(model, start, tight(method, 1e-3));
  }
}

TEST(FastEqualsMonolithic, LevelsInThePlane) {
  using body::CouplingLevel;
  test::BeamConstants beam;
  beam.EA = 1e4;
  beam.EIy = beam.EIz = 30;
  beam.elements = 2;
  for (const CouplingLevel level : {CouplingLevel::none, CouplingLevel::first_order,
                                    CouplingLevel::nocent, CouplingLevel::nojvar}) {
    SCOPED_TRACE(to_string(level));
    const model::Model model = test::planar_beam_pendulum(beam, level);
    const Start start = test::consistent_start(model);
    for (const Method method : {Method::generalized_alpha, Method::newmark}) {
      expect_same(model, start, tight(method, 1e-3));
    }
  }
}

TEST(FastEqualsMonolithic, LevelsInSpace) {
  using body::CouplingLevel;
  using body::CouplingTerm;
  test::BeamConstants beam = soft_damped_beam();
  beam.elements = 2;
  for (const body::CouplingChoice& choice :
       {body::CouplingChoice(CouplingLevel::first_order),
        body::CouplingChoice(CouplingLevel::full, {CouplingTerm::cent0, CouplingTerm::cor_ref}),
        body::CouplingChoice(CouplingLevel::full,
                             {CouplingTerm::cent1, CouplingTerm::cor_fe, CouplingTerm::eul_fe})}) {
    SCOPED_TRACE(to_string(choice.terms));
    const model::Model model = test::spatial_beam_pendulum(beam, choice);
    const Start start = test::consistent_start(model, [](model::State& state) {
      body::FrameMotion& frame = state.bodies[0].frame;
      frame.w << 3, -1, 4;
      frame.v = frame.w.cross(frame.X_WB.p);
    });
    expect_same(model, start, tight(Method::generalized_alpha, 1e-3));
  }
}

TEST(FastEqualsMonolithic, DrivenSliderCrank) {
  const model::Model model = test::slider_crank(4);
  const Start start = test::consistent_start(model);
  for (const Method method : kMethods) {
    expect_same(model, start, tight(method, 2e-5));
  }
}

TEST(FastEqualsMonolithic, BushingAndSpringBetweenRigidAndFlexibleBody) {
  // Forces of springs and dampers also weigh the position corrections.
  const model::Model model = test::bushed_beam(soft_damped_beam());
  const Start start = test::consistent_start(model);
  for (const Method method : kMethods) {
    expect_same(model, start, tight(method, 1e-3));
  }
}

using Laws = std::function<void(test::Mechanism&, const joints::JointCoordinate&)>;

/// A flexible rod on a hinge and a sled on a way across, drawn together by a spring from the tip.
model::Model rod_and_sled(const Vector3d& gravity, const Laws& on_hinge, const Laws& on_way) {
  test::Mechanism m;
  m.set_gravity(gravity);
  const test::BeamConstants beam = soft_damped_beam();
  m.set_length(beam.L);
  const int rod = m.add_flexible(test::straight_beam(beam), body::CouplingLevel::full, {});
  const int sled = m.add_rigid(0.8, Eigen::Vector3d(0.02, 0.03, 0.04).asDiagonal(), {});
  m.add_joint(joints::JointType::revolute, test::Mechanism::ground({0, 0, 0}),
              m.node_marker(rod, 0), Vector3d::UnitZ());
  on_hinge(m, joints::JointCoordinate::angle(Vector3d::UnitZ(), Eigen::Matrix3d::Identity()));
  m.add_joint(joints::JointType::prismatic, test::Mechanism::ground({0, 1, 0}),
              m.rigid_marker(sled, {0.1, 0, 0}), Vector3d::UnitX());
  on_way(m, joints::JointCoordinate::displacement(Vector3d::UnitX(), Vector3d(0.1, -1, 0)));
  m.add_load(std::make_unique<loads::SpringDamper>(200.0, 1.5, 1.2, std::nullopt),
             m.rigid_marker(sled, {0, 0.1, 0}), m.node_marker(rod, beam.elements));
  return m.take();
}

/// With a spring on the hinge, and friction and elastic stops on the way.
model::Model rubbing_rod() {
  return rod_and_sled(
      {2.0, -9.81, -4.0},
      [](test::Mechanism& m, const joints::JointCoordinate& angle) {
        m.add_law(std::make_unique<loads::CoordinateSpring>(30.0, 0.1, 0.3), angle);
      },
      [](test::Mechanism& m, const joints::JointCoordinate& way) {
        loads::FrictionData bed;
        bed.static_coefficient = bed.dynamic_coefficient = 0.1;
        bed.radius = 1.0;
        bed.slip = 1e-3;
        bed.inertia = 0.8;
        m.add_law(std::make_unique<loads::JointFriction>(bed, Vector3d::UnitX()), way);
        m.add_law(std::make_unique<loads::CoordinateStop>(-0.02, 0.01, 2e3, 5.0), way);
      });
}

TEST(FastEqualsMonolithic, FrictionStopsAndSpringsOnJointCoordinates) {
  const model::Model model = rubbing_rod();
  const Start start = test::consistent_start(model);
  for (const Method method : kMethods) {
    expect_same(model, start, tight(method, 1e-3));
  }
}

/// With rigid stops below the rod and ahead of the sled, which hold both at first.
model::Model stopped_rod() {
  return rod_and_sled(
      {0.0, -9.81, -4.0},
      [](test::Mechanism& m, const joints::JointCoordinate& angle) {
        m.add_law(std::make_unique<loads::RigidStop>(0.0, HUGE_VAL, 0.0, 1e-3), angle);
      },
      [](test::Mechanism& m, const joints::JointCoordinate& way) {
        m.add_law(std::make_unique<loads::RigidStop>(-0.5, 0.0, 0.0, 1e-3), way);
      });
}

TEST(FastEqualsMonolithic, RowsThatHoldRigidlyUntilTheyWouldPull) {
  const model::Model model = stopped_rod();
  Start start = test::consistent_start(model);
  for (const model::Load& load : model.loads) {
    if (load.rigid_row >= 0) start.state.memory.laws[load.first_state] = load.rigid_row + 1;
  }
  for (const Method method : {Method::generalized_alpha, Method::hht}) {
    expect_same(model, start, tight(method, 1e-3));
  }
  // Both stops hold at first; the spring lifts the rod off the one, and then draws the sled back
  // from the other.
  stepping::Stepper stepper(model, tight(Method::generalized_alpha, 1e-3), start.rows_in_use);
  for (int k = 0; k < kSteps; ++k) stepper.step(start.state);
  for (const model::Load& load : model.loads) {
    if (load.rigid_row >= 0) {
      EXPECT_EQ(start.state.memory.laws[load.first_state], 0);
    }
  }
}

/// A flexible shaft that a gear drives at one end, with its other wheel on an elastic bearing; a
/// drum on a carrier that is coupled to the shaft's far end and to a sled, one coordinate by a
/// polynomial; a rack on the sled. Numbers in no particular ratio.
model::Model geared_shaft(std::uint32_t seed) {
  std::mt19937 engine(seed);
  const auto any = [&](double from, double to) {
    return std::uniform_real_distribution(from, to)(engine);
  };
  using Kind = joints::JointCoordinate::Kind;
  test::Mechanism m;
  m.set_gravity({any(-3, 3), -9.81, any(-3, 3)});
  m.set_length(1.0);
  test::BeamConstants beam = soft_damped_beam();
  beam.elements = 2;
  const Eigen::Matrix3d J =
      Vector3d(any(0.02, 0.05), any(0.02, 0.05), any(0.02, 0.06)).asDiagonal();
  const int shaft = m.add_flexible(test::straight_beam(beam), body::CouplingLevel::full, {});
  const double reach = any(0.2, 0.4);
  const int wheel = m.add_rigid(any(0.5, 2), J, {{0, reach, 0}, Eigen::Quaterniond::Identity()});
  const int carrier = m.add_rigid(any(0.5, 2), J, {{1, 0, 0}, Eigen::Quaterniond::Identity()});
  const int sled =
      m.add_rigid(any(0.5, 2), J, {{0, reach - 0.1, 0.3}, Eigen::Quaterniond::Identity()});
  const Vector3d x = Vector3d::UnitX();
  m.add_joint(joints::JointType::revolute, test::Mechanism::ground({0, 0, 0}),
              m.node_marker(shaft, 0), x);
  m.add_joint(joints::JointType::revolute, test::Mechanism::ground({1, 0, 0}),
              m.rigid_marker(carrier, {0, 0, 0}), x);
  const auto tip = m.node_marker(shaft, 1);
  m.add_joint(joints::JointType::revolute, m.rigid_marker(carrier, {0, 0, 0}), tip, x);
  loads::Bushing::Coefficients k;
  k.stiffness << 4e4, 3e4, 5e4;
  k.rotational_stiffness << 0, 400, 500;
  k.damping << 2, 3, 1;
  m.add_load(std::make_unique<loads::Bushing>(k, Eigen::Matrix3d::Identity(), Vector3d::Zero()),
             test::Mechanism::ground({0, reach, 0}), m.rigid_marker(wheel, {0, 0, 0}));
  m.add_joint(joints::JointType::prismatic, test::Mechanism::ground({0, reach - 0.1, 0.3}),
              m.rigid_marker(sled, {0, 0, 0}), Vector3d::UnitZ());
  const double teeth = std::round(any(15, 40));
  m.add_joint(joints::JointType::gear, m.node_marker(shaft, 0), m.rigid_marker(wheel, {0, 0, 0}), x,
              std::nullopt, [&](joints::Placement& p) {
                p.sizes = {teeth, 27};
                p.pressure_angle = 0.35;
                p.helix_angle = any(-0.3, 0.3);
              });
  m.add_joint(joints::JointType::rack, m.rigid_marker(sled, {0, 0, 0}),
              m.rigid_marker(wheel, {0, 0, 0}), x, std::nullopt, [&](joints::Placement& p) {
                p.sizes = {0.1, 0.1};
                p.second_axis_F = Vector3d::UnitZ();
                p.pressure_angle = 0.35;
              });
  const int inner = m.add_coordinate(1, Kind::angle);
  const int outer = m.add_coordinate(2, Kind::angle);
  const int slide = m.add_coordinate(3, Kind::displacement);
  joints::CoordinateTerm curve;
  curve.function = joints::CoordinateFunction::polynomial({0, any(0.1, 0.3), any(-0.1, 0.1)});
  m.add_coupler({{slide, {any(0.5, 2), std::nullopt}},
                 {inner, curve},
                 {outer, {any(-0.2, -0.1), std::nullopt}}});
  return m.take();
}

TEST(FastEqualsMonolithic, GearsRacksAndCouplers) {
  for (const std::uint32_t seed : {0U, 1U, 2U, 4U}) {
    SCOPED_TRACE(seed);
    const model::Model model = geared_shaft(seed);
    const Start start = test::consistent_start(model);
    EXPECT_EQ(start.rows_in_use.size(), static_cast<std::size_t>(model.num_constraint_rows()));
    expect_same(model, start, tight(kMethods[seed % 4], 1e-3));
    // By Wilson's method rounding of reactions grows by e in 25 steps here, in either route: the
    // same one from accelerations that differ by 1e-14 ends 2e-8 apart after 200 steps.
    if (seed < 3) expect_same(model, start, tight(stepping::Method::wilson, 1e-3), 60);
  }
}

/// A swinging beam in two parts that are welded together, and two sliders on it that pass nodes and
/// the weld: one on a spring along the beam, with a load on an arm, one driven.
/// @param pulls the first moves a sled, too, by a law of its way
model::Model sliders_on_a_beam(std::optional<spatial::Plane> planar, bool pulls) {
  test::Mechanism m(planar);
  m.set_gravity({planar ? 0.0 : 1.3, -9.81, 0});
  m.set_length(1.0);
  test::BeamConstants beam = soft_damped_beam();
  beam.L = 0.5;
  beam.EA = 3e4;
  std::vector<model::MarkerId> way;
  const auto part = [&](double x) {
    const int body = m.add_flexible(test::straight_beam(beam, planar), body::CouplingLevel::full,
                                    {{x, 0, 0}, Eigen::Quaterniond::Identity()});
    // Nodes of the ends come first.
    for (const int node : {0, 2, 3, 4, 1}) {
      if (x == 0.0 || node != 0) way.push_back(m.node_marker(body, node));
    }
    return body;
  };
  part(0.0);
  m.add_joint(joints::JointType::revolute, test::Mechanism::ground({0, 0, 0}), way.front());
  const model::MarkerId inner = way.back();
  const int second = part(0.5);
  m.add_joint(joints::JointType::fixed, inner, m.node_marker(second, 0));
  const Eigen::Matrix3d J = Vector3d(0.02, 0.03, 0.04).asDiagonal();
  const auto bead = [&](double x) {
    return m.add_rigid(0.3, J, {{x, 0, 0}, Eigen::Quaterniond::Identity()});
  };
  const int one = bead(0.30);
  m.add_slider(way, m.rigid_marker(one, {0, 0, 0}));
  m.add_law(std::make_unique<loads::CoordinateSpring>(20.0, 0.3, 0.4),
            joints::JointCoordinate::displacement(Vector3d::UnitX(), Vector3d::Zero()));
  const int other = bead(0.45);
  m.add_slider(way, m.rigid_marker(other, {0, 0, 0}),
               base::TimeLaw::integral(base::TimeLaw::constant(0.4)));
  if (!pulls) return m.take();
  const auto displacement =
      joints::JointCoordinate::displacement(Vector3d::UnitX(), Vector3d::Zero());
  m.add_joint(joints::JointType::prismatic, test::Mechanism::ground({0.2, -1, 0}),
              m.rigid_marker(bead(0.2), {0, -1, 0}), Vector3d::UnitX());
  joints::CoordinateTerm curve;
  curve.function = joints::CoordinateFunction::polynomial({0.0, 0.8, 0.5});
  constexpr int kFirstSlider = 2, kSled = 4;  // behind the joints of the beam
  m.add_coupler({{m.add_coordinate(kSled, displacement), {-1.3, std::nullopt}},
                 {m.add_coordinate(kFirstSlider, displacement), curve}});
  return m.take();
}

TEST(FastEqualsMonolithic, SlidersOnAFlexibleBeam) {
  for (const auto& planar : {std::optional<spatial::Plane>(), std::optional(spatial::Plane::xy)}) {
    for (const bool pulls : {false, true}) {
      SCOPED_TRACE(std::string(planar ? "planar" : "in space") + (pulls ? ", pulling" : ", alone"));
      const model::Model model = sliders_on_a_beam(planar, pulls);
      const Start start = test::consistent_start(model);
      for (const Method method : {Method::generalized_alpha, Method::newmark, Method::hht}) {
        if (pulls && method != Method::generalized_alpha) continue;
        expect_same(model, start, tight(method, 1e-3));
      }
    }
  }
}

/// A wheel on a plane that is a swinging body, with the load of its own weight off its centre.
TEST(FastEqualsMonolithic, RollingWheels) {
  for (const double edge : {0.0, 0.05}) {
    test::Mechanism m;
    m.set_gravity({2.0, -1.0, -9.81});
    m.set_length(1.0);
    const Eigen::Matrix3d J = Vector3d(0.02, 0.03, 0.04).asDiagonal();
    const int table = m.add_rigid(5.0, 10.0 * J, {});
    const double tilt = 1.1;
    const int wheel = m.add_rigid(
        1.0, J, {{0.1, 0.2, 0.3}, Eigen::Quaterniond(Eigen::AngleAxisd(tilt, Vector3d::UnitX()))});
    m.add_joint(joints::JointType::spherical, test::Mechanism::ground({0, 0, -0.5}),
                m.rigid_marker(table, {0, 0, -0.5}));
    m.add_joint(joints::JointType::rolling, m.rigid_marker(table, {0, 0, 0}),
                m.rigid_marker(wheel, {0.02, 0, 0}), Vector3d::UnitZ(), std::nullopt,
                [&](joints::Placement& p) {
                  p.sizes = {0.3, 0.3};
                  p.edge = edge;
                  p.second_axis_F = p.R_WF.transpose() * p.R_WM * Vector3d::UnitZ();
                });
    const model::Model model = m.take();
    const Start start = test::consistent_start(model, [](model::State& state) {
      state.bodies[1].frame.w = {0.5, 1.0, -4.0};
      state.bodies[1].frame.v = {1.2, 0.0, 0.0};
    });
    EXPECT_EQ(start.rows_in_use.size(), 6U);
    // Not by Newmark's method, which keeps what rounding leaves in rates: 2.6e-10 rad at the end.
    for (const Method method : {Method::generalized_alpha, Method::hht}) {
      expect_same(model, start, tight(method, 1e-3));
    }
  }
}

TEST(FastEqualsMonolithic, NewmarkWithoutProjection) {
  const model::Model model = test::planar_beam_pendulum(test::BeamConstants{});
  const Start start = test::consistent_start(model);
  stepping::StepSettings settings = tight(Method::newmark, 1e-3);
  settings.position_projection = false;
  expect_same(model, start, settings);
}

TEST(FastEqualsMonolithic, StepsOfChangingLength) {
  const model::Model model = test::planar_beam_pendulum(soft_damped_beam());
  const Start start = test::consistent_start(model);
  for (const Method method : kMethods) {
    SCOPED_TRACE(stepping::to_string(method));
    stepping::StepSettings settings = tight(method, 1e-3);
    stepping::Stepper fast(model, settings, start.rows_in_use);
    MonolithicStepper slow(model, settings, start.rows_in_use);
    settings.step = 5e-4;
    stepping::Stepper fast_half(model, settings, start.rows_in_use);
    MonolithicStepper slow_half(model, settings, start.rows_in_use);
    model::State a = start.state;
    model::State b = start.state;
    Deviations deviations;
    for (int k = 0; k < 60; ++k) {
      const bool is_half = k % 3 > 0;
      (is_half ? fast_half : fast).step(a);
      (is_half ? slow_half : slow).step(b);
      deviations.add(a, b);
    }
    // As above, over fewer steps.
    EXPECT_LE(deviations.d.difference, 1e-10 * deviations.d.size);
    EXPECT_LE(deviations.p.difference, 1e-10 * deviations.p.size);
    EXPECT_LE(deviations.lambda.difference, 1e-9 * deviations.lambda.size);
  }
}

TEST(FastEqualsMonolithic, RigidDoublePendulumInSpace) {
  const model::Model model = test::rigid_double_pendulum(false);
  const Start start = test::consistent_start(model);
  for (const Method method : kMethods) {
    expect_same(model, start, tight(method, 1e-3));
  }
}

}  // namespace
}  // namespace buckens::verification::fast_equals_monolithic
