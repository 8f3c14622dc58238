// SPDX-License-Identifier: Apache-2.0
// Steps of machines: friction and stops in a four-bar, gears, a belt, and spheres that fall into a
// box and lie there in a heap.

#include <benchmark/benchmark.h>

#include "models.h"

#include "buckens/base/errors.h"

namespace {

using buckens::bench::Running;

constexpr double kStep = 2.5e-4;
// The uppermost of 1000 spheres lands after 0.55 s; what then bounces loses its speed soon.
constexpr double kAtRest = 1.2;

void step(benchmark::State& state, const std::string& text, double length) {
  Running run = buckens::bench::start(text, length);
  long iterations = 0;
  for (auto _ : state) {
    try {
      iterations += run.stepper->step(run.prepared.state).newton_iterations;
    } catch (const buckens::Error& error) {
      // A run of the program would go on with a smaller step, which is no figure to compare.
      state.SkipWithError(error.what());
      break;
    }
  }
  state.counters["newton/step"] =
      static_cast<double>(iterations) / static_cast<double>(state.iterations());
}

void four_bar_step(benchmark::State& state) { step(state, buckens::bench::four_bar(""), 1e-4); }
void four_bar_with_friction_and_stops_step(benchmark::State& state) {
  step(state, buckens::bench::four_bar(buckens::bench::friction_and_stops()), 1e-4);
}
void gear_train_step(benchmark::State& state) { step(state, buckens::bench::gear_train(), 1e-4); }
void belt_drive_step(benchmark::State& state) { step(state, buckens::bench::belt_drive(), 5e-4); }

void spheres_step(benchmark::State& state, double from) {
  Running run = buckens::bench::start(
      buckens::bench::spheres_in_a_box(static_cast<int>(state.range(0))), kStep);
  while (run.prepared.state.t < from) run.stepper->step(run.prepared.state);
  long iterations = 0;
  double pairs = 0;
  for (auto _ : state) {
    iterations += run.stepper->step(run.prepared.state).newton_iterations;
    pairs += static_cast<double>(run.prepared.state.memory.near.size());
  }
  const auto steps = static_cast<double>(state.iterations());
  state.counters["near pairs"] = pairs / steps;
  state.counters["newton/step"] = static_cast<double>(iterations) / steps;
  state.counters["per sphere"] =
      benchmark::Counter(static_cast<double>(state.range(0)) * steps,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void falling_spheres_step(benchmark::State& state) { spheres_step(state, 0.0); }
void heaped_spheres_step(benchmark::State& state) { spheres_step(state, kAtRest); }

BENCHMARK(four_bar_step)->Unit(benchmark::kMicrosecond);
BENCHMARK(four_bar_with_friction_and_stops_step)->Unit(benchmark::kMicrosecond);
BENCHMARK(gear_train_step)->Unit(benchmark::kMicrosecond);
BENCHMARK(belt_drive_step)->Unit(benchmark::kMicrosecond);
BENCHMARK(falling_spheres_step)
    ->Arg(100)
    ->Arg(1000)
    ->Iterations(400)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(heaped_spheres_step)->Arg(100)->Arg(1000)->Iterations(100)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
