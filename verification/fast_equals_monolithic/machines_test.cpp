// SPDX-License-Identifier: Apache-2.0
// Cables, cams, contacts, motors and signals on flexible bodies; see README.md.
#include <string>

#include <gtest/gtest.h>

#include "verification/fast_equals_monolithic/mechanism_of_text.h"

namespace buckens::verification::machines {
namespace {

using stepping::Method;

/// Two pulleys on the ends of a soft beam, a belt around them, a rope that slips over one.
constexpr const char* kCables = R"model(buckens: 1
planar: xy
gravity: [0, -9.81, 0]
materials: {plastic: {E: 1 GPa, nu: 0.3, rho: 1400, damping: {stiffness: 1e-4 s}}}
bodies:
  bracket: {beam: {to: [0.5, 0, 0], elements: 3, section: {circle: {diameter: 20 mm}}, material: plastic}}
  wheel: {rigid: {mass: 1, inertia: [0, 0, 0.002]}}
  fan: {rigid: {mass: 0.5, inertia: [0, 0, 0.003]}, at: {position: [0.5, 0, 0]}}
  light: {rigid: {mass: 0.4, inertia: [0, 0, 1e-3]}, at: {position: [0.42, -0.4, 0]}}
  heavy: {rigid: {mass: 1, inertia: [0, 0, 1e-3]}, at: {position: [0.58, -0.5, 0]}}
joints:
  root: {fixed: {between: [ground, bracket/start]}}
  axle: {revolute: {between: [ground, wheel]}}
  shaft: {revolute: {between: [bracket/end, fan]}}
loads:
  belt: {cable: {pulleys: [{on: wheel, radius: 0.05}, {on: fan, radius: 0.03}], stiffness: 2e4, damping-time: 1 ms, pretension: 20, friction: 0.3}}
  rope: {cable: {ends: [light, heavy], pulleys: [{on: fan, radius: 0.08, side: right}], stiffness: 2e4, damping-time: 0.5 ms, pretension: 6, friction: 0.2}}
  twist: {torque: {on: wheel, value: [0, 0, "0.4*sin(60*t)"]
}
}
)model";

/// A follower on a soft beam, pressed by a disc that turns off its centre.
constexpr const char* kCam = R"model(buckens: 1
planar: xy
gravity: [0, -9.81, 0]
materials: {plastic: {E: 1 GPa, nu: 0.3, rho: 1400, damping: {stiffness: 1e-4 s}}}
bodies:
  disc: {rigid: {mass: 1, inertia: [0, 0, 0.01]}}
  lever: {beam: {from: [-0.3, 0.1, 0], to: [0, 0.1, 0], elements: 3, section: {circle: {diameter: 15 mm}}, material: plastic}}
joints:
  shaft: {revolute: {between: [ground, disc/origin]}}
  root: {revolute: {between: [{ground: [-0.3, 0.1, 0]}, lever/start]}}
loads:
  cam: {cam: {between: [disc/origin, lever/end], closed: on, start: [120 mm, 0, 0], stiffness: 4e4, damping: 20,
              segments: [{arc: [-80 mm, 0, 0], through: [20 mm, 100 mm, 0]}, {arc: [120 mm, 0, 0], through: [20 mm, -100 mm, 0]}]}}
initial: {joints: {shaft: {speed: 25}}}
)model";

/// The end of a beam that swings onto a floor with friction, a ball that meets a capsule on the
/// beam.
constexpr const char* kContacts = R"model(buckens: 1
gravity: [0, 0, -9.81]
materials: {plastic: {E: 1 GPa, nu: 0.3, rho: 1400, damping: {stiffness: 1e-4 s}}}
bodies:
  arm: {beam: {to: [0.4, 0, 0], elements: 3, section: {circle: {diameter: 20 mm}}, material: plastic}}
  ball: {rigid: {mass: 0.2, inertia: [2e-5, 2e-5, 2e-5]}, at: {position: [0.21, 0.005, 0.041]}}
joints: {hinge: {spherical: {between: [ground, arm/start]}}}
loads:
  floor: {contact: {between: [{ground: [0, 0, -0.05]}, arm/end], shapes: [{plane: {normal: [0, 0.1, 1]}}, {sphere: 20 mm}], stiffness: 2e4, exponent: 1.5, restitution: 0.5, static: 0.3}}
  catch: {contact: {between: [arm/mid, ball], shapes: [{capsule: {radius: 10 mm, length: 0.2, axis: [1, 0, 0]}}, {sphere: 30 mm}], stiffness: 1e4, restitution: 0.6, static: 0.2}}
initial: {bodies: {arm: {velocity: [0, 0.6, -0.3], angular-velocity: [0, 1.5, 3]}}}
)model";

/// An arm under PD and under a limit, a controller with states that drives a sled on a soft rail.
constexpr const char* kMotors = R"model(buckens: 1
planar: xy
gravity: [0, -9.81, 0]
materials: {plastic: {E: 1 GPa, nu: 0.3, rho: 1400, damping: {stiffness: 1e-4 s}}}
bodies:
  arm: {beam: {to: [0.4, 0, 0], elements: 3, section: {circle: {diameter: 20 mm}}, material: plastic}}
  sled: {rigid: {mass: 0.3, inertia: [0, 0, 1e-3]}, at: {position: [0.4, 0, 0]}}
joints:
  hinge: {revolute: {between: [ground, arm/start]}}
  rail: {prismatic: {between: [arm/end, sled], axis: [0, 1, 0]}}
signals:
  way: {joint-displacement: rail}
  slow: {lag: {input: way, time-constant: 5 ms}}
  u: {pid: {input: "0.1*sin(20*t) - slow", proportional: 100, integral: 500, derivative: 2, filter: 1 ms, limits: [-4, 4]}}
loads:
  turn: {hinge-motor: {joint: hinge, angle: "0.6*sin(30*t)", stiffness: 200, damping: 3, torque-limit: 3 N m}}
  push: {slide-motor: {joint: rail, force: "u + 0.3*9.81"}}
)model";

constexpr Method kEvery[] = {Method::generalized_alpha, Method::newmark, Method::hht,
                             Method::wilson};

void expect_same_in(const std::string& text, int steps = 200) {
  const MechanismOfText machine(text);
  for (const Method method : kEvery) {
    expect_same(machine.built->model, machine.start, tight(method, 5e-4), steps);
  }
}

std::string without_friction(std::string text) {
  for (const std::string& key : {std::string(", friction: 0.3"), std::string(", friction: 0.2")}) {
    text.erase(text.find(key), key.size());
  }
  return text;
}

TEST(FastEqualsMonolithic, BeltsAndRopesOnFlexibleBrackets) {
  expect_same_in(kCables);
  expect_same_in(without_friction(kCables));
}

TEST(FastEqualsMonolithic, CamAndFlexibleFollower) { expect_same_in(kCam); }

TEST(FastEqualsMonolithic, ContactsOfAFlexibleArm) { expect_same_in(kContacts); }

TEST(FastEqualsMonolithic, MotorsAndControllers) { expect_same_in(kMotors); }

}  // namespace
}  // namespace buckens::verification::machines
