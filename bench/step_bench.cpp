// SPDX-License-Identifier: Apache-2.0
// Step time of beam bodies against one solve with the same factor, and of rigid chains. Quote
// ratios of one run: the machines that run this are shared.

#include <benchmark/benchmark.h>

#include "models.h"

#include "buckens/stepping/body_step_operator.h"

namespace {

using buckens::bench::Running;

constexpr double kStep = 1e-4;

void beam_solve(benchmark::State& state) {
  const Running run = buckens::bench::start(
      buckens::bench::beam_pendulum(static_cast<int>(state.range(0)), "none"), kStep);
  const auto& part = *run.built->model.bodies[0].flexible;
  const buckens::linalg::SparseCholesky factor(
      buckens::stepping::BodyStepOperator(part, run.stepper->scheme()).K_hat());
  buckens::linalg::Vector x = buckens::linalg::Vector::Ones(part.num_dofs());
  for (auto _ : state) {
    factor.solve_in_place(x);
    benchmark::DoNotOptimize(x.data());
    x.normalize();
  }
  state.counters["dof"] = static_cast<double>(part.num_dofs());
}

void beam_step(benchmark::State& state, const char* coupling) {
  Running run = buckens::bench::start(
      buckens::bench::beam_pendulum(static_cast<int>(state.range(0)), coupling), kStep);
  long iterations = 0;
  for (auto _ : state) iterations += run.stepper->step(run.prepared.state).newton_iterations;
  const double steps = static_cast<double>(state.iterations());
  state.counters["dof"] = static_cast<double>(run.built->model.bodies[0].num_dofs());
  state.counters["solves/step"] = static_cast<double>(run.stepper->counts(0).solves) / steps;
  state.counters["newton/step"] = static_cast<double>(iterations) / steps;
}

void rigid_chain_step(benchmark::State& state) {
  Running run =
      buckens::bench::start(buckens::bench::rigid_chain(static_cast<int>(state.range(0))), kStep);
  long iterations = 0;
  for (auto _ : state) iterations += run.stepper->step(run.prepared.state).newton_iterations;
  state.counters["newton/step"] =
      static_cast<double>(iterations) / static_cast<double>(state.iterations());
}

/// A step of one body with many frames; `per frame` is to stay constant.
void divided_step(benchmark::State& state, const std::string& text) {
  Running run = buckens::bench::start(text, kStep);
  long iterations = 0;
  for (auto _ : state) iterations += run.stepper->step(run.prepared.state).newton_iterations;
  const auto frames = static_cast<double>(run.built->model.bodies.size());
  state.counters["frames"] = frames;
  state.counters["newton/step"] =
      static_cast<double>(iterations) / static_cast<double>(state.iterations());
  state.counters["per frame"] =
      benchmark::Counter(frames * static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void divided_beam_step(benchmark::State& state) {
  divided_step(state, buckens::bench::divided_beam(static_cast<int>(state.range(0))));
}

void divided_tree_step(benchmark::State& state) {
  divided_step(state, buckens::bench::divided_tree(static_cast<int>(state.range(0))));
}

void planar_beam_step(benchmark::State& state) {
  divided_step(state, buckens::bench::planar_beam_pendulum(static_cast<int>(state.range(0))));
}

/// A reduced body on a ball joint.
void reduced_step(benchmark::State& state, const char* coupling) {
  Running run = buckens::bench::start(
      buckens::bench::reduced_block(static_cast<int>(state.range(0)), coupling), kStep);
  long iterations = 0;
  for (auto _ : state) iterations += run.stepper->step(run.prepared.state).newton_iterations;
  const double steps = static_cast<double>(state.iterations());
  state.counters["solves/step"] = static_cast<double>(run.stepper->counts(0).solves) / steps;
  state.counters["newton/step"] = static_cast<double>(iterations) / steps;
}

void mode_numbers(benchmark::internal::Benchmark* bench) {
  bench->Arg(8)->Arg(32)->Arg(128)->Unit(benchmark::kMicrosecond);
}

// 16 … 5000 elements: 102 … 30 006 DOF.
constexpr int kElements[] = {16, 50, 166, 500, 1666, 5000};

void beam_sizes(benchmark::internal::Benchmark* bench) {
  for (const int elements : kElements) bench->Arg(elements);
  bench->Unit(benchmark::kMicrosecond);
}

BENCHMARK(beam_solve)->Apply(beam_sizes);
BENCHMARK_CAPTURE(beam_step, none, "none")->Apply(beam_sizes);
BENCHMARK_CAPTURE(beam_step, full, "full")->Apply(beam_sizes);
BENCHMARK(rigid_chain_step)->RangeMultiplier(10)->Range(10, 100000)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(reduced_step, none, "none")->Apply(mode_numbers);
BENCHMARK_CAPTURE(reduced_step, first_order, "first-order")->Apply(mode_numbers);
BENCHMARK_CAPTURE(reduced_step, full, "full")->Apply(mode_numbers);
BENCHMARK(planar_beam_step)
    ->RangeMultiplier(4)
    ->Range(8, 2048)
    ->Arg(128)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(divided_beam_step)
    ->RangeMultiplier(4)
    ->Range(8, 2048)
    ->Arg(128)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(divided_tree_step)->DenseRange(3, 11, 2)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
