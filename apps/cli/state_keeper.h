// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "cli/run_journal.h"

#include "buckens/analysis/simulation/simulation.h"

namespace buckens::cli {

/// The user's options for saved states.
struct StateArguments {
  std::string save, start_from;                      ///< files; empty: none
  std::optional<double> save_at;                     ///< [s]; none: at the end
  analysis::Leeway leeway = analysis::Leeway::none;  ///< of the model that goes on

  /// @throws InputError if the time is outside the run, or has no file
  void check(double duration) const;
};

void add_state_options(CLI::App& verb, StateArguments& arguments);

/// Restores a saved state of a simulation, and saves its state at the requested time.
class StateKeeper {
 public:
  /// @throws InputError, IoError if there is a state to start from that does not fit
  StateKeeper(analysis::Simulation& simulation, const StateArguments& arguments,
              RunJournal& journal);
  /// Saves the state at the end, also that of an interrupted run. @throws IoError
  void save_end();

 private:
  void start();
  void save();

  analysis::Simulation& simulation_;
  const StateArguments& arguments_;
  RunJournal& journal_;
  bool is_saved_ = false;
};

}  // namespace buckens::cli
