// SPDX-License-Identifier: Apache-2.0
// Counts of what a step costs, which no other load on the machine can change, and ratios of times
// measured in turn. bench/guard.py compares them with those that are stored.
//
//     step_counts
//
// Prints one JSON object: per mechanism, factorisations; per step, solves, recycled answers, Newton
// iterations, numbers of the factor read, allocations.

#include <array>
#include <functional>
#include <iostream>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "machine_texts.h"
#include "models.h"
#include "solid_block.h"
#include "stopwatch.h"

#include "buckens/base/test/allocation_count.h"
#include "buckens/linalg/blas_kernels.h"
#include "buckens/linalg/solve_exchange.h"

namespace {

using buckens::bench::block_pendulum;
using buckens::bench::Running;
using buckens::bench::SolidBlock;
using buckens::bench::Stopwatch;
using nlohmann::json;

constexpr double kStep = 1e-4;
constexpr int kSteps = 400;

struct Case {
  std::string name;
  std::function<Running()> start;
};

Running start_block(const char* block, const char* level) {
  return buckens::bench::start(block_pendulum(SolidBlock::parse(block), level), kStep);
}

std::vector<Case> cases() {
  using namespace buckens::bench;
  std::vector<Case> out;
  for (const char* level : {"none", "first-order", "full"}) {
    out.push_back({fmt::format("block hex8 20 x 4 x 4, {}", level),
                   [level] { return start_block("hex8:20,4,4", level); }});
  }
  out.push_back(
      {"block tet10 10 x 2 x 2, full", [] { return start_block("tet10:10,2,2", "full"); }});
  out.push_back({"beam in space, 100 elements, full",
                 [] { return buckens::bench::start(beam_pendulum(100, "full"), kStep); }});
  out.push_back({"beam in the plane, 64 frames",
                 [] { return buckens::bench::start(planar_beam_pendulum(64), kStep); }});
  out.push_back(
      {"beam in space, 16 frames", [] { return buckens::bench::start(divided_beam(16), kStep); }});
  out.push_back({"reduced block, 8 modes, full",
                 [] { return buckens::bench::start(reduced_block(8, "full"), kStep); }});
  out.push_back(
      {"flexible slider-crank", [] { return buckens::bench::start(slider_crank(""), kStep); }});
  out.push_back({"flexible slider-crank, friction in all joints", [] {
                   return buckens::bench::start(slider_crank(friction_in_all_joints()), kStep);
                 }});
  out.push_back({"four-bar", [] { return buckens::bench::start(four_bar(""), kStep); }});
  out.push_back({"four-bar with friction and stops",
                 [] { return buckens::bench::start(four_bar(friction_and_stops()), kStep); }});
  out.push_back(
      {"cables over pulleys", [] { return buckens::bench::start(rope_and_belt(), kStep); }});
  out.push_back(
      {"contacts of many bodies", [] { return buckens::bench::start(rolling_balls(), kStep); }});
  out.push_back({"rigid stops, friction and ropes",
                 [] { return buckens::bench::start(rigid_stops_and_ropes(), kStep); }});
  out.push_back(
      {"trolleys on a rail", [] { return buckens::bench::start(trolleys_on_a_rail(), kStep); }});
  out.push_back({"rigid contacts with friction",
                 [] { return buckens::bench::start(rigid_contacts(), kStep); }});
  out.push_back({"surface of a solid on a plane",
                 [] { return buckens::bench::start(surface_on_a_plane(), kStep); }});
  out.push_back(
      {"motors and signals", [] { return buckens::bench::start(motors_and_signals(), kStep); }});
  out.push_back(
      {"rigid chain, 100 links", [] { return buckens::bench::start(rigid_chain(100), kStep); }});
  return out;
}

struct Totals {
  long factorisations = 0, solves = 0, recycled = 0;
};

Totals totals(const Running& run) {
  Totals out;
  for (std::size_t b = 0; b < run.built->model.bodies.size(); ++b) {
    const auto counts = run.stepper->counts(b);
    out.factorisations += counts.factorisations;
    out.solves += counts.solves;
    out.recycled += counts.recycled;
  }
  return out;
}

json count_steps(const Case& one) {
  Running run = one.start();
  auto& state = run.prepared.state;
  long iterations = 0;
  for (int k = 0; k < kSteps; ++k) iterations += run.stepper->step(state).newton_iterations;
  const Totals sums = totals(run);
  constexpr int kWatched = 50;
  const long allocations = buckens::test::count_allocations([&] {
    for (int k = 0; k < kWatched; ++k) run.stepper->step(state);
  });
  constexpr double kPerStep = 1.0 / kSteps;
  return {{"factorisations", sums.factorisations},
          {"factor_numbers", run.stepper->factor_entries()},
          {"solves", static_cast<double>(sums.solves) * kPerStep},
          {"recycled", static_cast<double>(sums.recycled) * kPerStep},
          {"iterations", static_cast<double>(iterations) * kPerStep},
          {"allocations", allocations}};
}

/// Passes over the common factor by six variants that step side by side.
json count_variants() {
  constexpr int kVariants = 6;
  constexpr int kTogether = 50;
  buckens::linalg::SolveExchange exchange;
  std::vector<Running> runs;
  for (int k = 0; k < kVariants; ++k) {
    std::string text = block_pendulum(SolidBlock::parse("hex8:20,4,4"), "full");
    const std::string gravity = "-9.81";
    text.replace(text.find(gravity), gravity.size(), fmt::format("{}", -9.81 + 0.1 * k));
    runs.push_back(buckens::bench::start(text, kStep, 1, &exchange));
  }
  const long passes = exchange.num_passes();
  const long columns = exchange.num_columns();
  std::vector<std::function<void()>> participants;
  for (Running& run : runs) {
    participants.emplace_back([&run] {
      for (int k = 0; k < kTogether; ++k) run.stepper->step(run.prepared.state);
    });
  }
  exchange.run(participants);
  return {{"factorisations", exchange.num_factorisations()},
          {"passes", static_cast<double>(exchange.num_passes() - passes) / kTogether},
          {"columns", static_cast<double>(exchange.num_columns() - columns) / kTogether}};
}

/// Shortest step of both, taken in turn so that both see the same machine.
double ratio_of_times(Running a, Running b) {
  std::array<double, 2> best = {std::numeric_limits<double>::max(),
                                std::numeric_limits<double>::max()};
  std::array<Running*, 2> runs = {&a, &b};
  for (int k = 0; k < kSteps; ++k) {
    for (std::size_t i = 0; i < 2; ++i) {
      const Stopwatch one;
      runs[i]->stepper->step(runs[i]->prepared.state);
      best[i] = std::min(best[i], one.seconds());
    }
  }
  return best[0] / best[1];
}

json time_ratios() {
  using namespace buckens::bench;
  json out;
  out["full over first-order, block hex8 20 x 4 x 4"] =
      ratio_of_times(start_block("hex8:20,4,4", "full"), start_block("hex8:20,4,4", "first-order"));
  out["first-order over none, block hex8 20 x 4 x 4"] =
      ratio_of_times(start_block("hex8:20,4,4", "first-order"), start_block("hex8:20,4,4", "none"));
  out["200 over 50 links of a rigid chain"] =
      ratio_of_times(buckens::bench::start(rigid_chain(200), kStep),
                     buckens::bench::start(rigid_chain(50), kStep));
  out["64 over 16 frames of a beam in the plane"] =
      ratio_of_times(buckens::bench::start(planar_beam_pendulum(64), kStep),
                     buckens::bench::start(planar_beam_pendulum(16), kStep));
  out["friction in all joints over none, flexible slider-crank with 8 beam elements"] =
      ratio_of_times(buckens::bench::start(slider_crank(friction_in_all_joints()), kStep),
                     buckens::bench::start(slider_crank(""), kStep));
  out["friction in all joints over none, slider-crank with a solid rod of 2775 variables"] =
      ratio_of_times(
          buckens::bench::start(solid_slider_crank(friction_in_all_joints_in_space()), kStep),
          buckens::bench::start(solid_slider_crank(""), kStep));
  const auto beam = [](bool side_by_side) {
    buckens::stepping::StepSettings settings;
    settings.step = kStep;
    settings.side_by_side = side_by_side;
    settings.simd = buckens::linalg::SimdLevel::portable;  // the same ratio on every processor
    return buckens::bench::start(
        buckens::model_file::read_model_text(planar_beam_pendulum(64), "bench.yaml", {}), settings);
  };
  out["side by side over one by one, 64 frames of a beam in the plane"] =
      ratio_of_times(beam(true), beam(false));
  return out;
}

}  // namespace

int main() {
  buckens::linalg::choose_blas_kernels();
  json out;
  for (const Case& one : cases()) out["counts"][one.name] = count_steps(one);
  out["counts"]["six variants of a block hex8 20 x 4 x 4"] = count_variants();
  out["ratios"] = time_ratios();
  std::cout << out.dump(1) << '\n';
}
