// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "buckens/analysis/initial/prepare.h"
#include "buckens/model_file/model_file.h"
#include "buckens/stepping/stepper.h"

namespace buckens::bench {

/// A mechanism that has been assembled and can be stepped.
struct Running {
  std::unique_ptr<model::BuiltModel> built;
  std::unique_ptr<dynamics::MassMetric> metric;
  analysis::Prepared prepared;
  std::unique_ptr<stepping::Stepper> stepper;
};

inline Running start(model::ModelDescription description, stepping::StepSettings settings) {
  Running run;
  run.built = model::build_model(std::move(description));
  run.metric = std::make_unique<dynamics::MassMetric>(run.built->model);
  run.prepared = analysis::prepare(*run.built, *run.metric);
  run.stepper =
      std::make_unique<stepping::Stepper>(run.built->model, settings, run.prepared.rows_in_use);
  return run;
}

inline Running start(model::ModelDescription description, double step, int threads = 1,
                     linalg::SolveExchange* exchange = nullptr) {
  stepping::StepSettings settings;
  settings.step = step;
  settings.threads = threads;
  settings.exchange = exchange;
  return start(std::move(description), settings);
}

inline Running start(const std::string& text, double step, int threads = 1,
                     linalg::SolveExchange* exchange = nullptr) {
  return start(model_file::read_model_text(text, "bench.yaml", {}), step, threads, exchange);
}

/// Steel beam of 1 m in space on a ball joint, falling from the horizontal.
inline std::string beam_pendulum(int elements, const char* coupling) {
  return fmt::format(R"(buckens: 1
gravity: [0, 0, -9.81]
bodies:
  rod:
    beam: {{to: [1, 0, 0], elements: {}, section: {{circle: {{diameter: 20 mm}}}},
           material: {{E: 200 GPa, nu: 0.3, rho: 7850}}}}
    coupling: {}
joints:
  pin: {{spherical: {{between: [ground, rod/start]}}}}
)",
                     elements, coupling);
}

/// The same beam with a frame per element.
inline std::string divided_beam(int frames) {
  std::string text = beam_pendulum(frames, "full");
  return text.replace(text.find("    coupling:"), 0, "    frames: per-element\n");
}

/// A planar beam with a frame per element that falls from the horizontal about a pin.
inline std::string planar_beam_pendulum(int frames) {
  return fmt::format(R"(buckens: 1
gravity: [0, -9.81, 0]
planar: xy
bodies:
  rod:
    beam: {{to: [1, 0, 0], elements: {}, section: {{circle: {{diameter: 20 mm}}}},
           material: {{E: 200 GPa, nu: 0.3, rho: 7850}}}}
    frames: per-element
joints:
  pin: {{revolute: {{between: [ground, rod/start]}}}}
)",
                     frames);
}

/// A block of solid elements, reduced, that falls from the horizontal on a ball joint.
inline std::string reduced_block(int modes, const char* coupling) {
  return fmt::format(R"(buckens: 1
gravity: [0, -9.81, 0]
bodies:
  block:
    mesh:
      box: {{size: [1, 0.1, 0.1], divisions: [36, 2, 2], element: hex8}}
      material: {{E: 210 GPa, nu: 0.3, rho: 7850}}
    reduction: {{free-free: {{modes: {}, static-correction: off}}}}
    coupling: {}
joints:
  pin: {{spherical: {{between: [ground, block/corner_000]}}}}
)",
                     modes, coupling);
}

/// Tree of beams in space with a frame per element: every branch ends in two of 0.7 its length.
/// @param levels 2^levels − 1 frames
inline std::string divided_tree(int levels) {
  std::string nodes = "        n0: [0, 0, 0]\n        n1: [0, 0, 1]\n";
  std::string beams = "        - {between: [n0, n1], section: pipe, material: steel}\n";
  std::vector<Eigen::Vector3d> at = {{0, 0, 0}, {0, 0, 1}};
  std::vector<int> parent = {0, 0};
  for (std::size_t n = 1; at.size() < (std::size_t{1} << levels); ++n) {
    const Eigen::Vector3d along = 0.7 * (at[n] - at[static_cast<std::size_t>(parent[n])]);
    const Eigen::Vector3d side = along.norm() * along.unitOrthogonal();
    for (const double sign : {1.0, -1.0}) {
      const Eigen::Vector3d end = at[n] + along + 0.5 * sign * side;
      nodes += fmt::format("        n{}: [{}, {}, {}]\n", at.size(), end.x(), end.y(), end.z());
      beams += fmt::format("        - {{between: [n{}, n{}], section: pipe, material: steel}}\n", n,
                           at.size());
      at.push_back(end);
      parent.push_back(static_cast<int>(n));
    }
  }
  return "buckens: 1\ngravity: [3, 0, -9.81]\n"
         "materials: {steel: {E: 200 GPa, nu: 0.3, rho: 7850}}\n"
         "sections: {pipe: {circle: {diameter: 20 mm}}}\n"
         "bodies:\n  tree:\n    frames: per-element\n    structure:\n      nodes:\n" +
         nodes + "      beams:\n" + beams +
         "joints: {foot: {fixed: {between: [ground, tree/n0]}}}\n";
}

/// A driven four-bar with a flexible coupler.
/// @param laws `loads:` of the model: friction in its joints, stops of the rocker; may be empty
inline std::string four_bar(const std::string& laws) {
  return R"(buckens: 1
planar: xy
materials: {steel: {E: 200 GPa, nu: 0.3, rho: 7850 kg/m^3}}
bodies:
  crank: {rigid: {mass: 0.4, com: [0.05, 0, 0], inertia: [0, 0, 4e-4]}, markers: {o: {position: [0, 0, 0]}, a: {position: [0.1, 0, 0]}}}
  coupler: {beam: {to: [0.18, 0.24, 0], elements: 8, section: {circle: {diameter: 12 mm}}, material: steel}, at: {position: [0.1, 0, 0]}}
  rocker: {rigid: {mass: 0.8, com: [0.315, 0.12, 0], inertia: [0, 0, 4e-3]}, markers: {b: {position: [0.28, 0.24, 0]}, c: {position: [0.35, 0, 0]}}}
joints:
  o: {revolute: {between: [ground, crank/o]}}
  drive: {prescribed-rotation: {between: [ground, crank/o], angle: "60*t rad"}}
  a: {revolute: {between: [crank/a, coupler/start]}}
  b: {revolute: {between: [coupler/end, rocker/b]}}
  c: {revolute: {between: [{ground: [0.35, 0, 0]}, rocker/c]}}
)" + laws;
}

inline std::string friction_and_stops() {
  return R"(loads:
  fo: {hinge-friction: {joint: o, static: 0.1, radius: 10 mm}}
  fa: {hinge-friction: {joint: a, static: 0.1, radius: 8 mm}}
  fb: {hinge-friction: {joint: b, static: 0.1, radius: 8 mm}}
  fc: {hinge-friction: {joint: c, static: 0.1, radius: 10 mm}}
  stop: {hinge-stop: {joint: c, from: -20 deg, to: 20 deg, stiffness: 20 N m/rad}}
)";
}

/// A slider-crank with an elastic rod, driven at 150 rad/s.
/// @param laws `loads:` of the model; may be empty
inline std::string slider_crank(const std::string& laws) {
  return R"(buckens: 1
planar: xy
materials: {steel: {E: 200 GPa, nu: 0.3, rho: 7870 kg/m^3, damping: {stiffness: 1e-6 s}}}
bodies:
  crank: {rigid: {mass: 0.36, com: [0.075, 0, 0], inertia: [0, 0, 2.727e-3]}, markers: {shaft: {position: [0, 0, 0]}, pin: {position: [0.15, 0, 0]}}}
  rod: {beam: {to: [0.3, 0, 0], elements: 8, section: {circle: {diameter: 8 mm}}, material: steel}, at: {position: [0.15, 0, 0]}}
  slider: {rigid: {mass: 0.033, inertia: [0, 0, 1e-6]}, at: {position: [0.45, 0, 0]}}
joints:
  shaft: {revolute: {between: [ground, crank/shaft]}}
  motor: {prescribed-rotation: {between: [ground, crank/shaft], angle: "150*t rad"}}
  big_end: {revolute: {between: [crank/pin, rod/start]}}
  small_end: {revolute: {between: [rod/end, slider]}}
  guide: {prismatic: {between: [ground, slider], axis: [1, 0, 0]}}
)" + laws;
}

/// Friction in all joints of the slider-crank.
inline std::string friction_in_all_joints() {
  return R"(loads:
  f_shaft: {hinge-friction: {joint: shaft, static: 0.1, radius: 10 mm}}
  f_big: {hinge-friction: {joint: big_end, static: 0.1, radius: 8 mm}}
  f_small: {hinge-friction: {joint: small_end, static: 0.1, radius: 8 mm}}
  f_guide: {slide-friction: {joint: guide, static: 0.1}}
)";
}

/// The same mechanism in space, with a rod of solid elements: some 2800 variables.
/// @param laws `loads:` of the model; may be empty
inline std::string solid_slider_crank(const std::string& laws) {
  return R"(buckens: 1
materials: {steel: {E: 200 GPa, nu: 0.3, rho: 7870 kg/m^3, damping: {stiffness: 1e-6 s}}}
bodies:
  crank: {rigid: {mass: 0.36, com: [0.075, 0, 0], inertia: [1e-4, 2.727e-3, 2.727e-3]}, markers: {shaft: {position: [0, 0, 0]}, pin: {position: [0.15, 0, 0]}}}
  rod:
    mesh: {box: {size: [0.3, 0.012, 0.008], divisions: [36, 4, 4], element: hex8}, material: steel}
    at: {position: [0.15, -0.006, -0.004]}
    interfaces: {big: {face: x0}, small: {face: x1}}
  slider: {rigid: {mass: 0.033, inertia: [1e-6, 1e-6, 1e-6]}, at: {position: [0.45, 0, 0]}}
joints:
  shaft: {revolute: {between: [ground, crank/shaft], axis: [0, 0, 1]}}
  motor: {prescribed-rotation: {between: [ground, crank/shaft], axis: [0, 0, 1], angle: "150*t rad"}}
  big_end: {revolute: {between: [crank/pin, rod/big], axis: [0, 0, 1]}}
  small_end: {spherical: {between: [rod/small, slider]}}
  guide: {prismatic: {between: [ground, slider], axis: [1, 0, 0]}}
)" + laws;
}

/// Friction in all joints of the slider-crank with a solid rod.
inline std::string friction_in_all_joints_in_space() {
  return R"(loads:
  f_shaft: {hinge-friction: {joint: shaft, static: 0.1, radius: 10 mm}}
  f_big: {hinge-friction: {joint: big_end, static: 0.1, radius: 8 mm}}
  f_small: {ball-friction: {joint: small_end, static: 0.1, radius: 8 mm}}
  f_guide: {slide-friction: {joint: guide, static: 0.1}}
)";
}

/// Two gears with helical teeth, and a flywheel behind a flexible shaft.
inline std::string gear_train() {
  return R"(buckens: 1
materials: {steel: {E: 206 GPa, nu: 0.3, rho: 7850 kg/m^3}}
bodies:
  motor: {rigid: {mass: 0.8 kg, inertia: [1e-3, 1e-3, 1.5e-3]}}
  wheel: {rigid: {mass: 4 kg, inertia: [7e-3, 7e-3, 12e-3]}, at: {position: [105 mm, 0, 0]}}
  shaft:
    beam: {to: [0, 0, 600 mm], elements: 6, section: {circle: {diameter: 16 mm}}, material: steel}
    at: {position: [105 mm, 0, 0]}
  flywheel: {rigid: {mass: 10 kg, inertia: [0.03, 0.03, 0.05]}, at: {position: [105 mm, 0, 600 mm]}}
joints:
  motor_bearing: {revolute: {between: [ground, motor], axis: [0, 0, 1]}}
  front_bearing: {revolute: {between: [{ground: [105 mm, 0, 0]}, wheel], axis: [0, 0, 1]}}
  rear_bearing: {cylindrical: {between: [{ground: [105 mm, 0, 600 mm]}, flywheel], axis: [0, 0, 1]}}
  key: {fixed: {between: [wheel, shaft/start]}}
  flange: {fixed: {between: [shaft/end, flywheel]}}
  teeth: {gear: {between: [motor, wheel], axis: [0, 0, 1], teeth: [20, 50], pressure-angle: 20 deg, helix-angle: 15 deg}}
loads: {drive: {torque: {on: motor, value: [0, 0, 0.1 N m]}}}
)";
}

/// A motor and a fan with an elastic belt, which slips.
inline std::string belt_drive() {
  return R"(buckens: 1
planar: xy
bodies:
  driver: {rigid: {mass: 1.2 kg, inertia: [0, 0, 1.5e-3 kg m^2]}}
  fan: {rigid: {mass: 4 kg, inertia: [0, 0, 20e-3 kg m^2]}, at: {position: [400 mm, 0, 0]}}
joints:
  motor_shaft: {revolute: {between: [ground, driver]}}
  fan_shaft: {revolute: {between: [{ground: [400 mm, 0, 0]}, fan]}}
loads:
  motor: {hinge-motor: {joint: motor_shaft, speed: 1500 rpm, damping: 0.5 N m s/rad, torque-limit: 30 N m}}
  duct: {hinge-brake: {joint: fan_shaft, torque: 20 N m}}
  belt: {elastic-belt: {between: [driver, fan], radii: [50 mm, 100 mm], stiffness: 50 kN, damping-time: 1 ms, pretension: 200 N, friction: 0.3}}
initial: {bodies: {driver: {angular-velocity: [0, 0, 1500 rpm]}, fan: {angular-velocity: [0, 0, 750 rpm]}}}
)";
}

/// A rope with slip over a wheel and a fixed pulley, and a closed belt from that wheel to a fan.
inline std::string rope_and_belt() {
  return R"(buckens: 1
planar: xy
gravity: [0, -9.81, 0]
bodies:
  light: {rigid: {mass: 1, inertia: [0, 0, 0.01]}, at: {position: [-0.1, -1, 0]}}
  heavy: {rigid: {mass: 2, inertia: [0, 0, 0.01]}, at: {position: [0.6, -1, 0]}}
  wheel: {rigid: {mass: 2, inertia: [0, 0, 0.01]}}
  fan: {rigid: {mass: 1, inertia: [0, 0, 0.02]}, at: {position: [0, 0.5, 0]}}
joints:
  axle: {revolute: {between: [ground, wheel]}}
  shaft: {revolute: {between: [{ground: [0, 0.5, 0]}, fan]}}
loads:
  rope: {cable: {ends: [light, heavy], pulleys: [{on: wheel, radius: 0.1, side: right}, {on: {ground: [0.5, 0, 0]}, radius: 0.1, side: right}], stiffness: 1e5, damping-time: 0.2 ms, pretension: 15, friction: 0.3}}
  belt: {cable: {pulleys: [{on: wheel, radius: 0.05}, {on: fan, radius: 0.08}], stiffness: 1e4, damping-time: 1 ms, pretension: 5, friction: 0.2}}
)";
}

/// Three balls that roll on a plane side by side and touch it all the time.
inline std::string rolling_balls() {
  return R"(buckens: 1
gravity: [0, 0, -9.81]
bodies:
  b0: {rigid: {mass: 30 g, inertia: [1.2e-6, 1.2e-6, 1.2e-6]}, at: {position: [0, 0, 9.985 mm]}}
  b1: {rigid: {mass: 30 g, inertia: [1.2e-6, 1.2e-6, 1.2e-6]}, at: {position: [0, 50 mm, 9.985 mm]}}
  b2: {rigid: {mass: 30 g, inertia: [1.2e-6, 1.2e-6, 1.2e-6]}, at: {position: [0, 100 mm, 9.985 mm]}}
loads:
  heap: {contacts: {among: [{on: ground, plane: [0, 0, 1]}, {bodies: "b*", sphere: 10 mm}], stiffness: 2e4, damping: 20, static: 0.3}}
initial: {bodies: {b0: {velocity: [0.1, 0, 0], angular-velocity: [0, 10, 0]}, b1: {velocity: [0.2, 0, 0]}}}
)";
}

/// Steel-like balls of 20 mm in layers of a box of planes, slightly out of line.
/// @param count up to 300: layers of 5 × 5; more: of 10 × 10
/// @param are_rigid without a stiffness, in steps of 1 ms
inline model::ModelDescription spheres_in_a_box(int count, bool are_rigid = false) {
  const int side = count > 300 ? 10 : 5;
  const double pitch = 0.0215;
  const double half = 0.5 * pitch * side;
  std::string text = fmt::format(R"(buckens: 1
gravity: [0, 0, -9.81]
bodies:
  ball: {{rigid: {{mass: 30 g, inertia: [1.2e-6, 1.2e-6, 1.2e-6]}}}}
loads:
  heap:
    contacts:
      among:
        - {{on: ground, plane: [0, 0, 1]}}
        - {{on: {{ground: [{0}, 0, 0]}}, plane: [-1, 0, 0]}}
        - {{on: {{ground: [-{0}, 0, 0]}}, plane: [1, 0, 0]}}
        - {{on: {{ground: [0, {0}, 0]}}, plane: [0, -1, 0]}}
        - {{on: {{ground: [0, -{0}, 0]}}, plane: [0, 1, 0]}}
        - {{bodies: "ball*", sphere: 10 mm}}
{1}      restitution: 0.4
      static: 0.3
{2})",
                                 half, are_rigid ? "" : "      stiffness: 2e4\n",
                                 are_rigid ? "simulation: {duration: 100 s, step: 1 ms}\n" : "");
  model::ModelDescription out = model_file::read_model_text(text, "bench.yaml", {});
  const body::BodySpec ball = out.bodies.front();
  out.bodies.clear();
  for (int k = 0; k < count; ++k) {
    const int layer = k / (side * side), row = k / side % side, column = k % side;
    body::BodySpec& one = out.bodies.emplace_back(ball);
    one.name = fmt::format("ball{}", k);
    one.at.position = {(column + 0.5) * pitch - half + 2e-4 * (k % 3 - 1),
                       (row + 0.5) * pitch - half + 2e-4 * (k % 5 - 2), 0.011 + pitch * layer};
  }
  return out;
}

/// Rigid links in space, each on a revolute joint, starting horizontally. The first two come from a
/// model file, the others are copies: they need no text, of which 100 000 links have 26 MB.
inline model::ModelDescription rigid_chain(int links) {
  std::string text = "buckens: 1\ngravity: [0, -9.81, 0]\nbodies:\n";
  for (int k = 0; k < 2; ++k) {
    text += fmt::format(
        "  link{0}:\n"
        "    rigid: {{mass: 1, com: [0.05, 0, 0], inertia: [1e-4, 1e-3, 1e-3]}}\n"
        "    markers: {{a: {{position: [0, 0, 0]}}, b: {{position: [0.1, 0, 0]}}}}\n"
        "    at: {{position: [{1}, 0, 0]}}\n",
        k, 0.1 * k);
  }
  text +=
      "joints:\n"
      "  j0: {revolute: {between: [ground, link0/a], axis: [0, 0, 1]}}\n"
      "  j1: {revolute: {between: [link0/b, link1/a], axis: [0, 0, 1]}}\n";
  model::ModelDescription out = model_file::read_model_text(text, "bench.yaml", {});
  for (int k = 2; k < links; ++k) {
    out.bodies.push_back(out.bodies[1]);
    out.bodies.back().name = fmt::format("link{}", k);
    out.bodies.back().at.position.x() = 0.1 * k;
    out.joints.push_back(out.joints[1]);
    out.joints.back().name = fmt::format("j{}", k);
    auto& between = std::get<joints::RevoluteSpec>(out.joints.back().kind).between;
    between[0].body = fmt::format("link{}", k - 1);
    between[1].body = fmt::format("link{}", k);
  }
  return out;
}

}  // namespace buckens::bench
