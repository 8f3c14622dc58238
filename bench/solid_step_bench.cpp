// SPDX-License-Identifier: Apache-2.0
// Steps of an unreduced solid body on a ball joint against CHOLMOD's solve with the same factor,
// set-up with few and many interface variables, and memory.
//
//     solid_step_bench hex8:274,10,10 [--levels none,first-order,full] [--threads 1,2]
//                      [--budget SECONDS] [--before STEPS] [--setup] [--no-reference]
//
// Those with `full` are measured after STEPS others, 100 by default, which gather the pairs that
// later solves are combined from. Prints one JSON object. Times are the shortest of several [s],
// those of steps among steps with the usual number of large solves; CHOLMOD's time is measured
// before and after the steps.

#include <algorithm>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "models.h"
#include "process_memory.h"
#include "solid_block.h"
#include "stopwatch.h"

#include "buckens/linalg/blas_kernels.h"
#include "buckens/linalg/sparse_cholesky.h"
#include "buckens/stepping/body_step_operator.h"

namespace {

using buckens::bench::block_pendulum;
using buckens::bench::process_memory;
using buckens::bench::Running;
using buckens::bench::shortest;
using buckens::bench::SolidBlock;
using buckens::bench::Stopwatch;
using buckens::body::CouplingTerms;
using buckens::linalg::SolveRoute;
using buckens::linalg::SparseCholesky;
using nlohmann::json;

constexpr double kStep = 1e-4;

struct Wanted {
  SolidBlock block;
  std::vector<std::string> levels = {"none", "first-order", "full"};
  std::vector<std::string> threads = {"1", "2"};
  double budget = 2.0;
  long before = 100;  // steps of `full` that are not measured
  bool setup = false;
  bool with_reference = true;
};

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> out(1);
  for (const char c : text) {
    if (c == ',') {
      out.emplace_back();
    } else {
      out.back() += c;
    }
  }
  return out;
}

/// Shortest solve by CHOLMOD with the factor of a step.
double reference_solve(const SparseCholesky& factor, double budget) {
  buckens::linalg::Vector x = buckens::linalg::Vector::Ones(factor.size());
  factor.solve_in_place(x);
  return shortest(
      budget, [&] { factor.solve_in_place(x); }, [&] { x.normalize(); });
}

/// Names of the levels of coupling.
CouplingTerms terms_of(const std::string& level) {
  if (level == "none") return CouplingTerms::none();
  if (level == "first-order") return CouplingTerms::first_order();
  return {};
}

buckens::linalg::SparseMatrix step_matrix(const buckens::body::FlexiblePart& part,
                                          const buckens::stepping::Scheme& scheme) {
  buckens::linalg::SparseMatrix out = scheme.mass * part.fe.M.whole() +
                                      scheme.stiffness * part.fe.K.whole() +
                                      scheme.damping * part.C.whole();
  out.makeCompressed();
  return out;
}

/// Steps that took the same number of large solves.
using AlikeSteps = std::vector<double>;  // [s]

/// The shortest, the first quartile, the median and the third quartile.
json quartiles_of(AlikeSteps times) {
  std::sort(times.begin(), times.end());
  json out;
  for (const std::size_t quarter : {0, 1, 2, 3}) {
    out.push_back(times[quarter * (times.size() - 1) / 4]);
  }
  return out;
}

json measure_level(Running& run, const std::string& level, int threads, const Wanted& wanted) {
  constexpr long kLeast = 3, kBefore = 4;
  buckens::model::State& state = run.prepared.state;
  state.bodies[0].terms = terms_of(level);
  state.history = 0;
  run.stepper->use_threads(threads);
  const long num_before = level == "full" ? wanted.before : kBefore;
  for (long k = 0; k < num_before; ++k) run.stepper->step(state);
  const long solves = run.stepper->counts(0).solves;
  const auto before = run.stepper->seconds();
  const long recycled = run.stepper->counts(0).recycled;
  long count = 0;
  double all_steps = 0;
  std::map<long, AlikeSteps> by_solves;
  for (const Stopwatch all; count < kLeast || all.seconds() < wanted.budget; ++count) {
    const long solved = run.stepper->counts(0).solves;
    const Stopwatch one;
    run.stepper->step(state);
    const double seconds = one.seconds();
    all_steps += seconds;
    by_solves[run.stepper->counts(0).solves - solved].push_back(seconds);
  }
  // A step that happens to need fewer solves than most is not representative.
  const auto usual = std::max_element(
      by_solves.begin(), by_solves.end(),
      [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); });
  const auto after = run.stepper->seconds();
  const auto steps = static_cast<double>(count);
  json out = {{"level", level}, {"threads", threads}};
  out["quartiles"] = quartiles_of(usual->second);
  out["step"] = out["quartiles"][0];
  out["mean_step"] = all_steps / steps;
  out["usual_solves"] = usual->first;
  out["steps"] = count;
  out["solves_per_step"] = static_cast<double>(run.stepper->counts(0).solves - solves) / steps;
  out["recycled_per_step"] =
      static_cast<double>(run.stepper->counts(0).recycled - recycled) / steps;
  out["mean_large_solves"] = (after.large_solves - before.large_solves) / steps;
  out["mean_newton"] = (after.newton - before.newton) / steps;
  out["mean_completion"] = (after.completion - before.completion) / steps;
  return out;
}

/// One body at all levels in turn: they share its factor.
json measure_steps(const Wanted& wanted) {
  const Stopwatch setup;
  Running run = buckens::bench::start(block_pendulum(wanted.block, "full"), kStep);
  json out = {{"set_up", setup.seconds()}, {"panel_bytes", run.stepper->factor_bytes()}};
  const auto& part = *run.built->model.bodies[0].flexible;
  out["dof"] = part.num_dofs();
  std::unique_ptr<SparseCholesky> reference;
  double solve = 0;
  if (wanted.with_reference) {
    reference =
        std::make_unique<SparseCholesky>(step_matrix(part, run.stepper->scheme()),
                                         buckens::linalg::CholeskyOptions{SolveRoute::cholmod});
    solve = reference_solve(*reference, 0.5 * wanted.budget);
  }
  json levels;
  for (const std::string& level : wanted.levels) {
    for (const std::string& threads : wanted.threads) {
      levels.push_back(measure_level(run, level, std::stoi(threads), wanted));
    }
  }
  if (reference) {  // others may have come or gone meanwhile
    out["cholmod"] = std::min(solve, reference_solve(*reference, 0.5 * wanted.budget));
  } else {
    out["resident_bytes"] = process_memory("VmRSS");
  }
  out["levels"] = levels;
  return out;
}

/// Columns G and what follows, the factor taken from elsewhere.
json measure_setup(const SolidBlock& block) {
  constexpr int kPoints = 19;  // and the joint: 60 interface variables
  Running run = buckens::bench::start(block_pendulum(block, "full", kPoints), kStep);
  auto& part = *run.built->model.bodies[0].flexible;
  part.num_interface_rows = 0;  // or the others would take its columns, too
  const Stopwatch factorisation;
  const buckens::stepping::BodyStepOperator with_factor(part, run.stepper->scheme());
  json out = {{"dof", part.num_dofs()}, {"with_factor", factorisation.seconds()}};
  for (const int variables : {12, 60}) {
    part.num_interface_rows = variables;
    const Stopwatch columns;
    const buckens::stepping::BodyStepOperator op(part, run.stepper->scheme(), {&with_factor});
    out[std::to_string(variables)] = columns.seconds();
    out["solves_" + std::to_string(variables)] = op.setup_solves();
  }
  return out;
}

Wanted read_arguments(int argc, char** argv) {
  Wanted out;
  for (int k = 1; k < argc; ++k) {
    const std::string key = argv[k];
    const bool has_value = k + 1 < argc;
    if (key == "--levels" && has_value) {
      out.levels = split(argv[++k]);
    } else if (key == "--threads" && has_value) {
      out.threads = split(argv[++k]);
    } else if (key == "--budget" && has_value) {
      out.budget = std::stod(argv[++k]);
    } else if (key == "--before" && has_value) {
      out.before = std::stol(argv[++k]);
    } else if (key == "--setup") {
      out.setup = true;
    } else if (key == "--no-reference") {
      out.with_reference = false;
    } else {
      out.block = SolidBlock::parse(key);
    }
  }
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  buckens::linalg::choose_blas_kernels();
  const Wanted wanted = read_arguments(argc, argv);
  json out = {{"element", wanted.block.element()},
              {"divisions", wanted.block.shape()},
              {"slender", wanted.block.is_slender()}};
  if (wanted.setup) {
    out["setup"] = measure_setup(wanted.block);
  } else {
    out["steps"] = measure_steps(wanted);
  }
  out["peak_bytes"] = process_memory("VmHWM");
  std::cout << out.dump(1) << '\n';
}
