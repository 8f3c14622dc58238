// SPDX-License-Identifier: Apache-2.0
// Steps of an unreduced solid body on a ball joint against CHOLMOD's solve with the same factor.
// Both times are the shortest of several in one run: others may use the machine, too.

#include <algorithm>
#include <chrono>
#include <limits>
#include <string>

#include <benchmark/benchmark.h>

#include "models.h"

#include "buckens/linalg/sparse_cholesky.h"
#include "buckens/stepping/body_step_operator.h"

namespace {

using buckens::bench::Running;
using buckens::linalg::SolveRoute;
using buckens::linalg::SparseCholesky;
using Clock = std::chrono::steady_clock;

constexpr double kStep = 1e-4;
constexpr int kReferenceSolves = 5;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Steel block of 1 × 0.1 × 0.1 m, falling from the horizontal on a ball joint at a corner.
std::string block_pendulum(const std::string& divisions, const char* coupling) {
  return fmt::format(R"(buckens: 1
gravity: [0, -9.81, 0]
bodies:
  block:
    mesh:
      box: {{size: [1, 0.1, 0.1], divisions: {}, element: hex8}}
      material: {{E: 210 GPa, nu: 0.3, rho: 7850, damping: {{mass: 0.1, stiffness: 1e-7 s}}}}
    coupling: {}
joints:
  pin: {{spherical: {{between: [ground, block/corner_000]}}}}
)",
                     divisions, coupling);
}

/// Shortest of a few solves by CHOLMOD with the factor of a step.
double reference_solve(const buckens::linalg::SparseMatrix& K_hat) {
  const SparseCholesky factor(K_hat, {SolveRoute::cholmod});
  buckens::linalg::Vector x = buckens::linalg::Vector::Ones(factor.size());
  double shortest = std::numeric_limits<double>::max();
  for (int k = 0; k < kReferenceSolves; ++k) {
    const auto start = Clock::now();
    factor.solve_in_place(x);
    shortest = std::min(shortest, seconds_since(start));
    x.normalize();
  }
  return shortest;
}

void solid_step(benchmark::State& state, const std::string& divisions, const char* coupling) {
  Running run = buckens::bench::start(block_pendulum(divisions, coupling), kStep,
                                      static_cast<int>(state.range(0)));
  const auto& part = *run.built->model.bodies[0].flexible;
  const double solve =
      reference_solve(buckens::stepping::BodyStepOperator(part, run.stepper->scheme()).K_hat());
  for (int k = 0; k < 4; ++k) run.stepper->step(run.prepared.state);
  const long solves = run.stepper->counts(0).solves;
  double shortest = std::numeric_limits<double>::max();
  for (auto _ : state) {
    const auto start = Clock::now();
    run.stepper->step(run.prepared.state);
    shortest = std::min(shortest, seconds_since(start));
  }
  state.counters["dof"] = static_cast<double>(part.num_dofs());
  state.counters["solves/step"] = static_cast<double>(run.stepper->counts(0).solves - solves) /
                                  static_cast<double>(state.iterations());
  state.counters["cholmod [ms]"] = 1e3 * solve;
  state.counters["shortest [ms]"] = 1e3 * shortest;
  state.counters["step/cholmod"] = shortest / solve;
}

void threads(benchmark::internal::Benchmark* bench) {
  bench->ArgName("threads")->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
}

constexpr const char* kBlock3000 = "[110, 2, 2]";
constexpr const char* kBlock10000 = "[133, 4, 4]";
constexpr const char* kBlock30000 = "[124, 8, 8]";
constexpr const char* kBlock100000 = "[274, 10, 10]";

BENCHMARK_CAPTURE(solid_step, 3000_none, kBlock3000, "none")->Apply(threads);
BENCHMARK_CAPTURE(solid_step, 10000_none, kBlock10000, "none")->Apply(threads);
BENCHMARK_CAPTURE(solid_step, 30000_none, kBlock30000, "none")->Apply(threads);
BENCHMARK_CAPTURE(solid_step, 30000_first_order, kBlock30000, "first-order")->Apply(threads);
BENCHMARK_CAPTURE(solid_step, 30000_full, kBlock30000, "full")->Apply(threads);
BENCHMARK_CAPTURE(solid_step, 100000_none, kBlock100000, "none")->Apply(threads);
BENCHMARK_CAPTURE(solid_step, 100000_first_order, kBlock100000, "first-order")->Apply(threads);
BENCHMARK_CAPTURE(solid_step, 100000_full, kBlock100000, "full")->Apply(threads);

}  // namespace

BENCHMARK_MAIN();
