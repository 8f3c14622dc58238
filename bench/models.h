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

inline Running start(model::ModelDescription description, double step, int threads = 1,
                     linalg::SolveExchange* exchange = nullptr) {
  Running run;
  run.built = model::build_model(std::move(description));
  run.metric = std::make_unique<dynamics::MassMetric>(run.built->model);
  run.prepared = analysis::prepare(*run.built, *run.metric);
  stepping::StepSettings settings;
  settings.step = step;
  settings.threads = threads;
  settings.exchange = exchange;
  run.stepper =
      std::make_unique<stepping::Stepper>(run.built->model, settings, run.prepared.rows_in_use);
  return run;
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

/// Rigid links in space, each on a revolute joint, starting horizontally. The first two come from a
/// model file, the others are copies: the text for ten thousand would exceed the size limit.
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
