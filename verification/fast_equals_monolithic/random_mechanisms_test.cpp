// SPDX-License-Identifier: Apache-2.0
// A hundred mechanisms made by chance, with every joint between rigid and flexible bodies, and
// gears, belts, racks, couplers, wheels and sliders at their ends; see README.md.
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "verification/fast_equals_monolithic/same_steps.h"

#include "buckens/dynamics/constraints.h"
#include "buckens/dynamics/forces.h"
#include "buckens/loads/ball_friction.h"
#include "buckens/loads/coordinate_law.h"
#include "buckens/loads/joint_friction.h"
#include "buckens/loads/spring_damper.h"
#include "buckens/spatial/test/marker_path.h"

namespace buckens::verification::random_mechanisms {
namespace {

using Eigen::Vector3d;
using joints::JointType;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr int kMechanisms = 100;
constexpr JointType kTypes[] = {
    JointType::revolute,      JointType::spherical,   JointType::prismatic,
    JointType::fixed,         JointType::cylindrical, JointType::planar,
    JointType::universal,     JointType::parallel,    JointType::constant_velocity,
    JointType::point_on_line, JointType::orientation, JointType::point_in_plane,
    JointType::distance,      JointType::screw,       JointType::slot};
/// What couples two shafts on a plate, or a body with the plate or with a beam.
enum class Partner { gear, belt, rack, coupler, wheel, slider };
constexpr Partner kPartners[] = {Partner::gear,    Partner::belt,  Partner::rack,
                                 Partner::coupler, Partner::wheel, Partner::slider};

/// Chance that gives the same numbers on every machine, unlike the distributions of <random>.
class Chance {
 public:
  explicit Chance(std::uint32_t seed) : engine_(seed) {}
  double between(double from, double to) {
    return from + (to - from) * static_cast<double>(engine_()) / 4294967296.0;
  }
  bool happens(double probability) { return between(0, 1) < probability; }
  Vector3d point(double size) {
    return {between(-size, size), between(-size, size), between(-size, size)};
  }
  Vector3d direction() {
    Vector3d n = point(1);
    while (n.norm() < 0.3) n = point(1);
    return n.normalized();
  }

 private:
  std::mt19937 engine_;
};

/// A body of the mechanism and the place where the next one hangs on it.
struct Link {
  int body = model::kGround;
  bool is_flexible = false;
  Vector3d end_W = Vector3d::Zero();
};

class MechanismByChance {
 public:
  explicit MechanismByChance(std::uint32_t seed) : chance_(seed) {
    mechanism_.set_gravity({chance_.between(-3, 3), -9.81, chance_.between(-3, 3)});
    mechanism_.set_length(1.0);
    Link parent;
    const int bodies = 2 + static_cast<int>(seed % 3);
    for (int k = 0; k < bodies; ++k) {
      // Every kind comes up equally often; what comes after it is by chance.
      const std::size_t type =
          k == 0 ? seed % std::size(kTypes)
                 : static_cast<std::size_t>(chance_.between(0, 1) *
                                            static_cast<double>(std::size(kTypes)));
      parent = add_link(parent, kTypes[type]);
    }
    add_partners(parent, kPartners[seed % std::size(kPartners)]);
  }
  model::Model take() { return mechanism_.take(); }

 private:
  Link add_link(const Link& parent, JointType type) {
    const bool is_apart = type == JointType::distance;
    const Vector3d start =
        parent.end_W + (is_apart ? Vector3d(0.3 * chance_.direction()) : Vector3d::Zero());
    const spatial::Pose X{start, spatial::exp_rotation(chance_.point(1.5))};
    Link link;
    link.is_flexible = chance_.happens(0.5);
    model::MarkerId near;
    if (link.is_flexible) {
      test::BeamConstants beam = soft_damped_beam();
      beam.elements = 2;
      beam.L = 0.6;
      link.body = mechanism_.add_flexible(test::straight_beam(beam), body::CouplingLevel::full, X);
      link.end_W = X * Vector3d(beam.L, 0, 0);
      near = mechanism_.node_marker(link.body, 0);
    } else {
      const Eigen::Matrix3d J = Vector3d(chance_.between(0.02, 0.05), chance_.between(0.02, 0.05),
                                         chance_.between(0.02, 0.05))
                                    .asDiagonal();
      const Vector3d com = chance_.point(0.2);
      link.body = mechanism_.add_rigid(chance_.between(0.5, 2), J, {X * com, X.q});
      link.end_W = X * chance_.point(0.4);
      near = mechanism_.rigid_marker(link.body, -com, spatial::exp_rotation(chance_.point(1)));
    }
    join(parent, type, near);
    // Springs keep what a joint leaves free from falling out of reach.
    mechanism_.add_load(std::make_unique<loads::SpringDamper>(40.0, 0.5, 0.1, std::nullopt), near,
                        test::Mechanism::ground(start + 0.3 * chance_.direction()));
    return link;
  }

  void join(const Link& parent, JointType type, const model::MarkerId& near) {
    const model::MarkerId far = end_of(parent);
    const Vector3d axis = chance_.direction();
    add_joint(type, far, near, axis, [&](joints::Placement& p) {
      p.pitch = chance_.between(0.02, 0.1);
      if (type == JointType::universal) p.second_axis_F = axis.unitOrthogonal();
      if (type == JointType::slot) {
        const Vector3d along = chance_.direction();
        const Vector3d across = along.unitOrthogonal();
        p.path = {-0.6 * along, -0.3 * along + 0.05 * across, Vector3d::Zero(),
                  0.3 * along - 0.05 * across, 0.6 * along};
      }
    });
    const Eigen::Matrix3d R_FM =
        mechanism_.world_pose(far).R().transpose() * mechanism_.world_pose(near).R();
    if (type == JointType::revolute) {
      mechanism_.add_law(std::make_unique<loads::CoordinateSpring>(3.0, 0.05, 0.2),
                         joints::JointCoordinate::angle(axis, R_FM));
    }
    add_friction_and_stops(type, axis, R_FM);
  }

  void add_friction_and_stops(JointType type, const Vector3d& axis, const Eigen::Matrix3d& R_FM) {
    using joints::JointCoordinate;
    const auto rub = [&](double radius, double inertia, const JointCoordinate& coordinate) {
      mechanism_.add_law(std::make_unique<loads::JointFriction>(friction(radius, inertia), axis),
                         coordinate);
    };
    // Near enough to be struck within the steps.
    const auto stop = [&](double way, double stiffness, const JointCoordinate& coordinate) {
      mechanism_.add_law(
          std::make_unique<loads::CoordinateStop>(-way, 1.5 * way, stiffness, 0.01 * stiffness),
          coordinate);
    };
    const JointCoordinate angle = JointCoordinate::angle(axis, R_FM);
    const JointCoordinate way = JointCoordinate::displacement(axis, Vector3d::Zero());
    if (type == JointType::prismatic || type == JointType::cylindrical) {
      rub(1.0, 0.8, way);
      stop(2e-3, 2e3, way);
    }
    if (type == JointType::revolute || type == JointType::cylindrical) {
      rub(0.02, 0.03, angle);
      stop(4e-3, 50.0, angle);
    }
    if (type == JointType::spherical) {
      mechanism_.add_law_of_joint(
          std::make_unique<loads::BallFriction>(friction(0.02, 0.03), std::nullopt));
    }
  }

  static loads::FrictionData friction(double radius, double inertia) {
    loads::FrictionData data;
    data.static_coefficient = data.dynamic_coefficient = 0.1;
    data.radius = radius;
    data.slip = 1e-3;
    data.inertia = inertia;
    return data;
  }

  model::MarkerId end_of(const Link& link) {
    if (link.body == model::kGround) return test::Mechanism::ground(link.end_W);
    if (link.is_flexible) return mechanism_.node_marker(link.body, kEndNode);
    return mechanism_.marker_at(link.body, link.end_W);
  }

  /// A body at a place, with axes of the world.
  int body_at(const Vector3d& place) {
    const Eigen::Matrix3d J = Vector3d(chance_.between(0.02, 0.05), chance_.between(0.02, 0.05),
                                       chance_.between(0.02, 0.05))
                                  .asDiagonal();
    return mechanism_.add_rigid(chance_.between(0.5, 2), J,
                                {place, Eigen::Quaterniond::Identity()});
  }

  /// A shaft in the plate, on a spring. @return the angle as a coordinate
  int add_shaft(int plate, int wheel, const Vector3d& place, const Vector3d& axis) {
    add_joint(JointType::revolute, mechanism_.marker_at(plate, place),
              mechanism_.marker_at(wheel, place), axis);
    mechanism_.add_law(std::make_unique<loads::CoordinateSpring>(3.0, 0.05, 0.2),
                       joints::JointCoordinate::angle(axis, Eigen::Matrix3d::Identity()));
    return mechanism_.add_coordinate(num_joints_ - 1, joints::JointCoordinate::Kind::angle);
  }

  void add_partners(const Link& end, Partner partner) {
    const Vector3d place = end.end_W;
    const int plate = body_at(place + 0.1 * chance_.direction());
    add_joint(JointType::fixed, end_of(end), mechanism_.marker_at(plate, place));
    const Vector3d axis = chance_.direction();
    const Vector3d along = axis.unitOrthogonal();
    if (partner == Partner::slider) return add_slider(plate, place);
    if (partner == Partner::wheel) return add_wheel(plate, place, axis, along);
    const int one = body_at(place);
    const int first = add_shaft(plate, one, place, axis);
    if (partner == Partner::rack) return add_rack(plate, one, place, axis, along);
    const Vector3d aside = place + 0.3 * along;
    const int two = body_at(aside);
    const int second = add_shaft(plate, two, aside, axis);
    if (partner == Partner::coupler) {
      joints::CoordinateTerm curve;
      curve.function =
          joints::CoordinateFunction::polynomial({0, chance_.between(0.5, 1), 0.1, -0.05});
      mechanism_.add_coupler({{first, curve}, {second, {chance_.between(-2, -1), std::nullopt}}});
      return;
    }
    const bool is_gear = partner == Partner::gear;
    add_joint(is_gear ? JointType::gear : JointType::belt, mechanism_.marker_at(one, place),
              mechanism_.marker_at(two, aside), axis, [&](joints::Placement& p) {
                p.sizes = {is_gear ? 17.0 : 0.1, is_gear ? 29.0 : 0.06};
                p.pressure_angle = is_gear ? 0.35 : 0.0;
                p.helix_angle = is_gear ? chance_.between(-0.3, 0.3) : 0.0;
              });
  }

  void add_rack(int plate, int pinion, const Vector3d& place, const Vector3d& axis,
                const Vector3d& along) {
    const Vector3d below = place - 0.1 * axis.cross(along);
    const int sled = body_at(below);
    add_joint(JointType::prismatic, mechanism_.marker_at(plate, below),
              mechanism_.marker_at(sled, below), along);
    add_joint(JointType::rack, mechanism_.marker_at(sled, below),
              mechanism_.marker_at(pinion, place), axis, [&](joints::Placement& p) {
                p.sizes = {0.1, 0.1};
                p.second_axis_F = along;
                p.pressure_angle = 0.35;
              });
  }

  /// A wheel on the plate as its plane, which a spring keeps from rolling far.
  void add_wheel(int plate, const Vector3d& place, const Vector3d& normal, const Vector3d& along) {
    const double radius = 0.2;
    // It leans against the plane's normal.
    const Vector3d axle = (along + chance_.between(-0.4, 0.4) * normal).normalized();
    const Vector3d up = (normal - axle * axle.dot(normal)).normalized();
    const Vector3d centre = place + radius * up;
    const int wheel = body_at(centre);
    const model::MarkerId plane = mechanism_.marker_at(plate, place);
    const model::MarkerId hub = mechanism_.marker_at(wheel, centre);
    add_joint(JointType::rolling, plane, hub, normal, [&](joints::Placement& p) {
      p.sizes = {radius, radius};
      p.second_axis_F = axle;
    });
    mechanism_.add_load(std::make_unique<loads::SpringDamper>(40.0, 0.5, 0.1, std::nullopt), hub,
                        mechanism_.marker_at(plate, centre + 0.3 * chance_.direction()));
  }

  /// A bead on a beam that is welded to the plate.
  void add_slider(int plate, const Vector3d& place) {
    test::BeamConstants beam = soft_damped_beam();
    beam.elements = 2;
    beam.L = 0.6;
    const spatial::Pose X{place, spatial::exp_rotation(chance_.point(1.5))};
    const int rail =
        mechanism_.add_flexible(test::straight_beam(beam), body::CouplingLevel::full, X);
    std::vector<model::MarkerId> nodes;
    for (const int node : {0, 2, 1}) nodes.push_back(mechanism_.node_marker(rail, node));
    add_joint(JointType::fixed, mechanism_.marker_at(plate, place), nodes.front());
    const Vector3d at = X * Vector3d(chance_.between(0.25, 0.35), 0, 0);
    const int bead = body_at(at);
    mechanism_.add_slider(nodes, mechanism_.marker_at(bead, at));
    ++num_joints_;
    mechanism_.add_law(std::make_unique<loads::CoordinateSpring>(20.0, 0.3, 0.1),
                       joints::JointCoordinate::displacement(Vector3d::UnitX(), Vector3d::Zero()));
  }

  void add_joint(JointType type, const model::MarkerId& first, const model::MarkerId& second,
                 const Vector3d& axis_F = Vector3d::UnitZ(),
                 const std::function<void(joints::Placement&)>& more = nullptr) {
    mechanism_.add_joint(type, first, second, axis_F, std::nullopt, more);
    ++num_joints_;
  }

  // The nodes of a beam's ends come first.
  static constexpr int kEndNode = 1;

  Chance chance_;
  test::Mechanism mechanism_;
  int num_joints_ = 0;
};

test::Start thrown(const model::Model& model, std::uint32_t seed) {
  Chance chance(seed + 1000);
  return test::consistent_start(model, [&](model::State& state) {
    for (model::BodyState& body : state.bodies) {
      body.frame.v = chance.point(0.5);
      body.frame.w = chance.point(1.0);
    }
  });
}

TEST(RandomMechanisms, StepAsTheMonolithicRoute) {
  for (std::uint32_t seed = 0; seed < kMechanisms; ++seed) {
    SCOPED_TRACE(seed);
    const model::Model model = MechanismByChance(seed).take();
    expect_same(model, thrown(model, seed), tight(kMethods[seed % 4], 1e-3), 20);
  }
}

/// Motions a little before and after, with the rates that the mechanism has.
std::vector<dynamics::BodyMotion> moved(const std::vector<dynamics::BodyMotion>& start, double t) {
  std::vector<dynamics::BodyMotion> out = start;
  for (dynamics::BodyMotion& motion : out) {
    motion.frame.X_WB.p += t * motion.frame.v;
    motion.frame.X_WB.q = motion.frame.X_WB.q * spatial::exp_rotation(t * motion.frame.w);
    motion.y += t * motion.y_dot;
  }
  return out;
}

TEST(RandomMechanisms, RowsHaveTheDerivativesOfTheirResidualsAndDoTheirWork) {
  for (std::uint32_t seed = 0; seed < kMechanisms; ++seed) {
    SCOPED_TRACE(seed);
    const model::Model model = MechanismByChance(seed).take();
    test::Start start = thrown(model, seed);
    auto motions = dynamics::motions_of(model, start.state);
    // Off the joints' manifold, where nothing cancels.
    Chance chance(seed + 2000);
    for (dynamics::BodyMotion& motion : motions) {
      motion.frame.v += chance.point(0.5);
      motion.frame.w += chance.point(1.0);
    }
    const auto residual = [&](double t) {
      dynamics::Constraints at;
      dynamics::evaluate_constraints(model, moved(motions, t), 0.0, &start.state.memory, at);
      return linalg::Vector(at.g);
    };
    dynamics::Constraints now;
    dynamics::evaluate_constraints(model, motions, 0.0, &start.state.memory, now);
    const linalg::Vector rates = test::derivative(residual, 1e-4);
    // Rounding ε/h = 2e-12 and truncation (ω h)⁴ are far below.
    for (const model::Joint& joint : model.joints) {
      for (std::size_t k = 0; k < joint.rows.size(); ++k) {
        if (joint.rows[k].holds_rates_only()) continue;  // of no position
        const auto row = joint.first_row + static_cast<Eigen::Index>(k);
        EXPECT_LE(std::abs(now.g_dot[row] - rates[row]), 1e-9 * (1 + std::abs(rates[row])));
      }
    }

    linalg::Vector lambda(model.num_constraint_rows());
    for (double& force : lambda) force = chance.between(-1, 1);
    dynamics::Forces forces;
    forces.reset(model);
    dynamics::add_joint_forces(now, lambda, forces);
    double power = 0;
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      Vector6 u;
      u << motions[b].frame.w, motions[b].frame.v;
      power +=
          forces.frame[b].dot(u) - model.bodies[b].mass * model.gravity.dot(motions[b].frame.v);
      if (model.bodies[b].is_flexible()) power += forces.interface[b].dot(motions[b].y_dot);
    }
    EXPECT_NEAR(power, lambda.dot(now.g_dot - now.g_t),
                1e-12 * (1 + lambda.lpNorm<1>() * rates.lpNorm<1>()));
  }
}

/// Power of all loads but gravity.
double power_of_loads(const model::Model& model, const std::vector<dynamics::BodyMotion>& motions,
                      const dynamics::Forces& forces) {
  double out = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    Vector6 u;
    u << motions[b].frame.w, motions[b].frame.v;
    out += forces.frame[b].dot(u) - model.bodies[b].mass * model.gravity.dot(motions[b].frame.v);
    if (model.bodies[b].is_flexible()) out += forces.interface[b].dot(motions[b].y_dot);
  }
  return out;
}

TEST(RandomMechanisms, WhatFrictionStopsAndSpringsDoIsStoredOrLost) {
  int rubbing = 0, stopped = 0;
  for (std::uint32_t seed = 0; seed < kMechanisms; ++seed) {
    SCOPED_TRACE(seed);
    const model::Model model = MechanismByChance(seed).take();
    test::Start start = thrown(model, seed);
    stepping::Stepper stepper(model, tight(stepping::Method::generalized_alpha, 1e-3),
                              start.rows_in_use);
    model::State state = start.state;
    model::RowMemory before;
    for (int k = 0; k < 10; ++k) {
      before = state.memory;
      stepper.step(state);
    }
    // Seen from the last step, laws are within their regimes, not at their borders.
    const dynamics::Circumstances around{&state.inputs, &before, &state.lambda, nullptr, nullptr};
    const auto motions = dynamics::motions_of(model, state);
    dynamics::Forces forces;
    const auto stored = [&](double t) {
      dynamics::evaluate_forces(model, moved(motions, t), state.t, around, forces);
      return linalg::Vector(linalg::Vector::Constant(1, forces.stored_energy));
    };
    const double rate = test::derivative(stored, 1e-7)[0];
    dynamics::evaluate_forces(model, motions, state.t, around, forces);
    EXPECT_GE(forces.dissipation, 0.0);
    rubbing += std::count_if(forces.regimes.begin(), forces.regimes.end(),
                             [](int regime) { return regime == 1 || regime == -1; }) > 0;
    stopped += std::any_of(model.loads.begin(), model.loads.end(), [&](const model::Load& load) {
      return dynamic_cast<const loads::CoordinateStop*>(load.element.get()) != nullptr;
    });
    const double power = power_of_loads(model, motions, forces);
    // The stiffness of sticking follows the bound b, and with the multipliers as they are the
    // reaction turns with the bodies: ½ z_s ḃ, of slips of 1e-3.
    const double size = std::abs(forces.active_power) + std::abs(rate) + forces.stored_energy;
    EXPECT_NEAR(power, forces.active_power - rate, 1e-4 * (1 + size));
  }
  // Most of them have something to rub and to strike.
  EXPECT_GT(rubbing, kMechanisms / 3);
  EXPECT_GT(stopped, kMechanisms / 3);
}

}  // namespace
}  // namespace buckens::verification::random_mechanisms
