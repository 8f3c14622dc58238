// SPDX-License-Identifier: Apache-2.0
#include "cli/continuation.h"

#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "buckens/analysis/simulation/later_end.h"
#include "buckens/base/errors.h"
#include "buckens/base/units.h"
#include "buckens/run_store/run_files.h"
#include "buckens/run_store/state_file.h"

namespace buckens::cli {

namespace fs = std::filesystem;

namespace {

void require_run_to_continue(const fs::path& directory) {
  std::error_code error;
  if (!fs::is_regular_file(directory / run_store::kSummaryName, error)) {
    throw IoError(
        fmt::format("{}: not a run directory: it holds no {}. Give --continue the directory that "
                    "`buckens run` has written (-o).",
                    directory.string(), run_store::kSummaryName));
  }
  if (!fs::is_regular_file(directory / run_store::kCheckpointName, error)) {
    throw IoError(
        fmt::format("{}: there is no checkpoint to continue from: the run ended before its first "
                    "one, or the model says `checkpoint: off`. Run the model from the start; "
                    "simulation.checkpoint is the time between checkpoints.",
                    directory.string()));
  }
}

/// The time that --until gives, in seconds.
double end_of_run(const std::string& text) {
  const base::QuantityText parts = base::split_quantity(text);
  const auto number = base::parse_number(parts.formula);
  const auto unit = base::parse_unit(parts.unit.empty() ? "s" : parts.unit);
  if (!number || !unit || unit->dimension != base::kTime) {
    throw InputError(
        fmt::format("--until {}: this is no time; give a number in seconds, or one with a unit of "
                    "time: --until 0.03, --until 30ms",
                    text));
  }
  return *number * unit->factor;
}

}  // namespace

void add_continuation_options(CLI::App& verb, ContinuationArguments& arguments) {
  verb.add_option("--continue", arguments.directory,
                  "Continue the run in OUT from its last checkpoint, after Ctrl-C, a\n"
                  "crash, a full disk or a failed step. Without MODEL, the model that\n"
                  "was run is used; --set may change step and tolerance")
      ->type_name("OUT");
  verb.add_option("--until", arguments.until,
                  "With --continue: end of the run, later or earlier than planned;\n"
                  "in seconds, or with a unit: 30ms")
      ->type_name("T");
}

Continuation::Continuation(fs::path directory) : directory_(std::move(directory)) {
  require_run_to_continue(directory_);
  const base::SavedValues state = run_store::read_state(checkpoint());
  try {
    kept_ = run_store::continuation_from(state);
  } catch (const IoError& error) {
    throw IoError(fmt::format("{}: {}", checkpoint().string(), error.what()));
  }
  if (!kept_.is_steered) return;
  throw InputError(
      fmt::format("{0}: functions or values of a Python program act on this run, which the program "
                  "cannot call. Continue it there: buckens.Simulation.resume(\"{0}\", model) with "
                  "the same model and functions.",
                  directory_.string()));
}

fs::path Continuation::model() const { return directory_ / run_store::kModelName; }

fs::path Continuation::checkpoint() const { return directory_ / run_store::kCheckpointName; }

std::vector<std::string> Continuation::changes_until(const model::ModelDescription& description,
                                                     const std::string& text) const {
  const double until = end_of_run(text);
  if (!(until > kept_.time)) {
    throw InputError(
        fmt::format("--until {}: the run in {} has already reached t = {:.9g} s; give a later time",
                    text, directory_.string(), kept_.time));
  }
  return analysis::changes_for_end(description, {kept_.march_start, kept_.longest_step}, until);
}

}  // namespace buckens::cli
