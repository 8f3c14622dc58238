// SPDX-License-Identifier: Apache-2.0
#include "cli/state_keeper.h"

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/run_store/state_file.h"

namespace buckens::cli {

namespace {

// Times are given in decimals, ends of steps are counted.
constexpr double kSameInstant = 1e-9;

}  // namespace

void StateArguments::check(double duration) const {
  if (!save_at) return;
  if (save.empty()) {
    throw InputError("--save-state-at: there is no file for the state; add --save-state FILE");
  }
  if (*save_at > 0.0 && *save_at <= duration * (1.0 + kSameInstant)) return;
  throw InputError(
      fmt::format("--save-state-at {:g}: the run goes from 0 to {:g} s; give a time "
                  "within",
                  *save_at, duration));
}

void add_state_options(CLI::App& verb, StateArguments& arguments) {
  verb.add_option("--save-state", arguments.save,
                  "Save the final state to FILE, for --start-from; an interrupted run\n"
                  "saves it, too")
      ->type_name("FILE");
  verb.add_option("--save-state-at", arguments.save_at,
                  "Save the state at the end of the step that reaches this time [s],\n"
                  "instead of the final state")
      ->type_name("T");
  verb.add_option("--start-from", arguments.start_from,
                  "Continue from a saved state of the same model, with results bitwise\n"
                  "identical to an uninterrupted run; title and duration may change")
      ->type_name("FILE");
}

StateKeeper::StateKeeper(analysis::Simulation& simulation, const StateArguments& arguments,
                         RunJournal& journal)
    : simulation_(simulation), arguments_(arguments), journal_(journal) {
  if (!arguments.start_from.empty()) start();
  if (!arguments.save_at) return;
  if (simulation.time() >= *arguments.save_at) {
    throw InputError(
        fmt::format("--save-state-at {:g}: the run goes on from t = {:g} s; give a "
                    "later time",
                    *arguments.save_at, simulation.time()));
  }
  simulation.on_step([this](const analysis::StepView& now) {
    if (is_saved_ || now.time() < *arguments_.save_at - kSameInstant * now.step()) return;
    save();
  });
}

void StateKeeper::start() {
  const std::string& file = arguments_.start_from;
  const base::SavedValues state = run_store::read_state(file);
  try {
    simulation_.restore(state, arguments_.leeway);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file, error.what()));
  }
  if (simulation_.is_done()) {
    throw InputError(
        fmt::format("{}: the state is that at the end of the run, t = {:g} s; give "
                    "the model a longer simulation.duration, with --set, or with --until "
                    "where the run itself goes on",
                    file, simulation_.time()));
  }
  journal_.say(base::LogLevel::info,
               fmt::format("goes on from {}, t = {:.6g} s", file, simulation_.time()));
}

void StateKeeper::save() {
  run_store::write_state(simulation_.save_to_write(), arguments_.save);
  is_saved_ = true;
  journal_.say(base::LogLevel::info, fmt::format("state at t = {:.6g} s saved in {}",
                                                 simulation_.time(), arguments_.save));
}

void StateKeeper::save_end() {
  if (arguments_.save.empty() || is_saved_) return;
  if (arguments_.save_at) {
    journal_.say(base::LogLevel::warning,
                 fmt::format("the run ended before t = {:g} s: {} holds the state of its end",
                             *arguments_.save_at, arguments_.save));
  }
  save();
}

}  // namespace buckens::cli
