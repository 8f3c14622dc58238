// SPDX-License-Identifier: Apache-2.0
// Six variants of one model with a solid body that advance concurrently and share a factor,
// against one of them alone.
//
//     variant_bench hex8:124,8,8 [--steps N]
//
// Prints one JSON object; times per step of all variants [s].

#include <cstring>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "models.h"
#include "solid_block.h"
#include "stopwatch.h"

#include "buckens/linalg/blas_kernels.h"
#include "buckens/linalg/solve_exchange.h"

namespace {

using buckens::bench::SolidBlock;
using buckens::bench::Stopwatch;
using nlohmann::json;

constexpr double kStep = 1e-4;
constexpr int kVariants = 6;
constexpr int kRounds = 3;

/// A block on a ball joint; the variants differ in gravity.
std::string block_pendulum(const SolidBlock& block, const std::string& level, double gravity) {
  return fmt::format(R"(buckens: 1
gravity: [0, {}, 0]
bodies:
  block:
    mesh:
      box: {{size: [{}, 0.1, 0.1], divisions: [{}, {}, {}], element: {}}}
      material: {{E: 210 GPa, nu: 0.3, rho: 7850}}
    coupling: {}
joints:
  pin: {{spherical: {{between: [ground, block/corner_000]}}}}
)",
                     gravity, block.size().x(), block.divisions[0], block.divisions[1],
                     block.divisions[2], block.element(), level);
}

/// Time per step of `count` variants that share one factor [s], the shortest of a few rounds.
double time_per_step(const SolidBlock& block, const std::string& level, int count, int steps) {
  buckens::linalg::SolveExchange exchange;
  std::vector<buckens::bench::Running> runs;
  for (int k = 0; k < count; ++k) {
    runs.push_back(buckens::bench::start(block_pendulum(block, level, -9.81 + 0.1 * k), kStep, 1,
                                         count > 1 ? &exchange : nullptr));
  }
  double best = 0;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<std::function<void()>> participants;
    for (auto& run : runs) {
      participants.emplace_back([&run, steps] {
        for (int k = 0; k < steps; ++k) run.stepper->step(run.prepared.state);
      });
    }
    const Stopwatch all;
    if (count > 1) {
      exchange.run(participants);
    } else {
      participants.front()();
    }
    const double one = all.seconds() / steps;
    // The first steps build up the history of the coupling.
    if (round == 1 || (round > 1 && one < best)) best = one;
  }
  return best;
}

}  // namespace

int main(int argc, char** argv) {
  buckens::linalg::choose_blas_kernels();
  SolidBlock block;
  int steps = 20;
  for (int k = 1; k < argc; ++k) {
    if (std::strcmp(argv[k], "--steps") == 0 && k + 1 < argc) {
      steps = std::stoi(argv[++k]);
    } else {
      block = SolidBlock::parse(argv[k]);
    }
  }
  json out = {
      {"element", block.element()}, {"divisions", block.shape()}, {"slender", block.is_slender()}};
  for (const std::string level : {"none", "full"}) {
    out[level] = {{"one", time_per_step(block, level, 1, steps)},
                  {"six", time_per_step(block, level, kVariants, steps)}};
  }
  std::cout << out.dump(1) << '\n';
}
