// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace buckens::bench {

/// A link that lies on a rigid stop, with friction that sticks rigidly, beside a weight on a taut
/// rope.
inline std::string rigid_stops_and_ropes() {
  return R"model(buckens: 1
planar: xy
gravity: [0, -9.81, 0]
bodies:
  link: {rigid: {mass: 1 kg, com: [0.25, 0, 0], inertia: [0, 0, 0.02]}}
  slide: {rigid: {mass: 0.5 kg, inertia: [0, 0, 1e-3]}, at: {position: [0.8, 0, 0]}}
  weight: {rigid: {mass: 0.5 kg, inertia: [0, 0, 1e-3]}, at: {position: [1.2, -0.5, 0]}}
joints:
  hinge: {revolute: {between: [ground, link/origin]}}
  way: {prismatic: {between: [{ground: [0.8, 0, 0]}, slide], axis: [1, 0, 0]}}
loads:
  rest: {hinge-stop: {joint: hinge, from: 0 deg, restitution: 0}}
  hold: {slide-friction: {joint: way, static: 0.3, stick: rigid}}
  rope: {rope: {between: [{ground: [1.2, 0, 0]}, weight], length: 0.5 m, restitution: 0}}
)model";
}

/// A trolley between rigid stops on a flexible rail, with friction that sticks rigidly, pulls a
/// sled by a string; another one lies at its stop.
inline std::string trolleys_on_a_rail() {
  return R"model(buckens: 1
gravity: [0, -9.81, 0]
materials: {steel: {E: 200 GPa, nu: 0.3, rho: 7850 kg/m^3, damping: {stiffness: 1e-5 s}}}
bodies:
  rail: {beam: {to: [2, 0.2, 0], elements: 10, section: {circle: {diameter: 30 mm}}, material: steel}, frames: 2}
  trolley: {rigid: {mass: 0.5 kg, inertia: [1, 1, 1]}, at: {position: [0.5, 0.05, 0]}}
  parked: {rigid: {mass: 0.5 kg, inertia: [1, 1, 1]}, at: {position: [0.3, 0.03, 0]}}
  sled: {rigid: {mass: 0.2 kg, inertia: [1, 1, 1]}, at: {position: [0, 1, 0]}}
joints:
  root: {fixed: {between: [ground, rail/start]}}
  tip: {point-on-line: {between: [{ground: [2, 0.2, 0]}, rail/end], axis: [1, 0.1, 0]}}
  wheels: {slider-on-beam: {between: [rail, trolley]}}
  hole: {slider-on-beam: {between: [rail, parked]}}
  way: {prismatic: {between: [ground, sled], axis: [1, 0, 0]}}
  string: {coupler: {of: {wheels: 1, way: -1}}}
loads:
  ends: {slide-stop: {joint: wheels, from: -0.1 m, to: 1 m, restitution: 0.5}}
  rub: {slide-friction: {joint: wheels, static: 0.1, stick: rigid}}
  rest: {slide-stop: {joint: hole, from: 0 m, restitution: 0}}
initial: {joints: {wheels: {velocity: 1}}}
)model";
}

/// Two boxes and a ball on a rigid plane with friction: one box slides, one stands, the ball rolls.
inline std::string rigid_contacts() {
  return R"model(buckens: 1
gravity: [0, 0, -9.81]
bodies:
  still: {rigid: {mass: 1 kg, inertia: [2e-3, 2e-3, 2e-3]}, at: {position: [0, 0, 0.05]}}
  sliding: {rigid: {mass: 1 kg, inertia: [2e-3, 2e-3, 2e-3]}, at: {position: [0, 0.5, 0.05]}}
  ball: {rigid: {mass: 1 kg, inertia: [1e-3, 1e-3, 1e-3]}, at: {position: [0, 1, 0.05]}}
loads:
  a: {contact: {between: [ground, still], shapes: [{plane: {}}, {box: [0.1, 0.1, 0.1]}], static: 0.3}}
  b: {contact: {between: [ground, sliding], shapes: [{plane: {}}, {box: [0.1, 0.1, 0.1]}], static: 0.3}}
  c: {contact: {between: [ground, ball], shapes: [{plane: {}}, {sphere: 50 mm}], static: 0.3}}
initial: {bodies: {sliding: {velocity: [1, 0, 0]}, ball: {velocity: [1, 0, 0], angular-velocity: [0, 20, 0]}}}
)model";
}

/// A soft block of solid elements that lies on a plane with its whole face.
inline std::string surface_on_a_plane() {
  return R"model(buckens: 1
gravity: [0, 0, -9.81]
materials: {rubber: {E: 5 MPa, nu: 0.3, rho: 1200, damping: {stiffness: 1 ms}}}
bodies:
  block:
    mesh: {box: {size: [0.1, 0.1, 0.1], divisions: [2, 2, 2]}, material: rubber}
    interfaces: {foot: {face: z0}}
loads:
  floor: {contact: {between: [ground, block/foot], shapes: [{plane: {}}, {surface: {}}], stiffness: 2e4, damping: 50, static: 0.3}}
initial: {bodies: {block: {velocity: [0.2, 0, 0]}}}
)model";
}

/// A flexible arm under a motor at its limit, a sled on it under a controller with states.
inline std::string motors_and_signals() {
  return R"model(buckens: 1
planar: xy
gravity: [0, -9.81, 0]
bodies:
  arm: {beam: {to: [0.4, 0, 0], elements: 6, section: {circle: {diameter: 20 mm}}, material: {E: 1 GPa, nu: 0.3, rho: 1400}}}
  sled: {rigid: {mass: 0.3, inertia: [0, 0, 1e-3]}, at: {position: [0.4, 0, 0]}}
joints:
  hinge: {revolute: {between: [ground, arm/start]}}
  rail: {prismatic: {between: [arm/end, sled], axis: [0, 1, 0]}}
signals:
  way: {joint-displacement: rail}
  slow: {lag: {input: way, time-constant: 5 ms}}
  u: {pid: {input: "0.1*sin(20*t) - slow", proportional: 100, integral: 500, derivative: 2, filter: 1 ms, limits: [-4, 4]}}
loads:
  turn: {hinge-motor: {joint: hinge, angle: "0.6*sin(30*t)", stiffness: 200, damping: 3, torque-limit: 1 N m}}
  push: {slide-motor: {joint: rail, force: "u + 0.3*9.81"}}
)model";
}

}  // namespace buckens::bench
