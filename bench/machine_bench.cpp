// SPDX-License-Identifier: Apache-2.0
// Steps of machines: friction and stops in a four-bar, friction in a flexible slider-crank, gears,
// a belt, and spheres that fall into a box and lie there in a heap.

#include <benchmark/benchmark.h>

#include "models.h"

#include "buckens/analysis/simulation/simulation.h"
#include "buckens/base/errors.h"
#include "buckens/stepping/time_march.h"

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
void slider_crank_step(benchmark::State& state) {
  step(state, buckens::bench::slider_crank(""), 1e-4);
}
void slider_crank_with_friction_step(benchmark::State& state) {
  step(state, buckens::bench::slider_crank(buckens::bench::friction_in_all_joints()), 1e-4);
}
void solid_slider_crank_step(benchmark::State& state) {
  step(state, buckens::bench::solid_slider_crank(""), 1e-4);
}
void solid_slider_crank_with_friction_step(benchmark::State& state) {
  step(state, buckens::bench::solid_slider_crank(buckens::bench::friction_in_all_joints_in_space()),
       1e-4);
}
void gear_train_step(benchmark::State& state) { step(state, buckens::bench::gear_train(), 1e-4); }
void belt_drive_step(benchmark::State& state) { step(state, buckens::bench::belt_drive(), 5e-4); }

/// As the program does it: what does not settle is repeated with shorter steps, which count as
/// parts of the step.
void spheres_step(benchmark::State& state, double from) {
  Running run = buckens::bench::start(
      buckens::bench::spheres_in_a_box(static_cast<int>(state.range(0))), kStep);
  buckens::stepping::StepSettings settings;
  settings.step = kStep;
  constexpr long kMostSteps = 100000;
  buckens::stepping::TimeMarch march(run.built->model, settings, run.prepared.rows_in_use,
                                     {kStep * kMostSteps, 0.0, kMostSteps, {}});
  buckens::model::State before = run.prepared.state, after = before;
  long whole = 0, iterations = 0;
  const auto advance = [&] {
    for (++whole; after.t < kStep * (static_cast<double>(whole) - 1e-6);) {
      std::swap(before, after);
      iterations += march.advance(before, after).newton_iterations;
    }
  };
  while (after.t < from) advance();
  iterations = 0;
  const long failed = march.report().failed;
  double pairs = 0;
  for (auto _ : state) {
    advance();
    pairs += static_cast<double>(after.memory.near.size());
  }
  const auto steps = static_cast<double>(state.iterations());
  state.counters["near pairs"] = pairs / steps;
  state.counters["newton/step"] = static_cast<double>(iterations) / steps;
  state.counters["repeated"] = static_cast<double>(march.report().failed - failed) / steps;
  state.counters["per sphere"] =
      benchmark::Counter(static_cast<double>(state.range(0)) * steps,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// Whole steps of the program, which finds pairs after each of them.
void rigid_spheres_step(benchmark::State& state) {
  const auto built = buckens::model::build_model(
      buckens::bench::spheres_in_a_box(static_cast<int>(state.range(0)), true));
  buckens::analysis::Simulation simulation(*built);
  for (auto _ : state) {
    try {
      simulation.step();
    } catch (const buckens::Error& error) {
      state.SkipWithError(error.what());
      break;
    }
  }
  state.counters["near pairs"] = static_cast<double>(simulation.built().model.pair_loads.size());
}

void falling_spheres_step(benchmark::State& state) { spheres_step(state, 0.0); }
void heaped_spheres_step(benchmark::State& state) { spheres_step(state, kAtRest); }

BENCHMARK(four_bar_step)->Unit(benchmark::kMicrosecond);
BENCHMARK(four_bar_with_friction_and_stops_step)->Unit(benchmark::kMicrosecond);
BENCHMARK(slider_crank_step)->Unit(benchmark::kMicrosecond);
BENCHMARK(slider_crank_with_friction_step)->Unit(benchmark::kMicrosecond);
BENCHMARK(solid_slider_crank_step)->Unit(benchmark::kMicrosecond);
BENCHMARK(solid_slider_crank_with_friction_step)->Unit(benchmark::kMicrosecond);
BENCHMARK(gear_train_step)->Unit(benchmark::kMicrosecond);
BENCHMARK(belt_drive_step)->Unit(benchmark::kMicrosecond);
BENCHMARK(falling_spheres_step)
    ->Arg(100)
    ->Arg(1000)
    ->Iterations(400)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(rigid_spheres_step)->Arg(20)->Arg(100)->Iterations(400)->Unit(benchmark::kMicrosecond);
BENCHMARK(heaped_spheres_step)->Arg(100)->Arg(1000)->Iterations(100)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
