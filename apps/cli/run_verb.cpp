// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/build.h"
#include "cli/continuation.h"
#include "cli/error_statement.h"
#include "cli/failure.h"
#include "cli/interruption.h"
#include "cli/journaled_sink.h"
#include "cli/number_range.h"
#include "cli/output.h"
#include "cli/progress_display.h"
#include "cli/run_journal.h"
#include "cli/state_keeper.h"
#include "cli/summary_text.h"
#include "cli/verbs.h"

#include "buckens/analysis/error/variants.h"
#include "buckens/analysis/simulation/checkpoints.h"
#include "buckens/analysis/simulation/output_plan.h"
#include "buckens/analysis/simulation/simulation.h"
#include "buckens/base/allowed_threads.h"
#include "buckens/base/errors.h"
#include "buckens/base/version.h"
#include "buckens/base/work.h"
#include "buckens/files/output_file.h"
#include "buckens/linalg/factor_cache.h"
#include "buckens/model_file/model_file.h"

namespace buckens::cli {

namespace {

namespace fs = std::filesystem;
using base::LogLevel;

struct RunArguments {
  std::string model, out;
  std::vector<std::string> overrides;
  bool quiet = false;
  bool error = false;
  int threads = 1;
  std::string factors;
  StateArguments state;
  ContinuationArguments continuation;

  fs::path directory() const {
    return out.empty() ? fs::path(model).stem() += ".out" : fs::path(out);
  }
};

std::unique_ptr<model::BuiltModel> read_model_to_run(const RunArguments& arguments) {
  model::ModelDescription description =
      model_file::read_model_file(arguments.model, arguments.overrides);
  if (!description.simulation) {
    throw InputError(description.where,
                     "there is no `simulation:`, so the duration is unknown. Add, for instance, "
                     "`simulation: {duration: 1 s, step: 1 ms}`, or use `buckens check`.");
  }
  const base::AllowedThreads threads(arguments.threads);
  return build(std::move(description));
}

/// Shows progress until the user asks to stop.
class Watch {
 public:
  Watch(ProgressDisplay& display, RunJournal& journal, const Interruption& interruption)
      : display_(display), journal_(journal), interruption_(interruption) {}

  bool operator()(const analysis::Progress& progress) {
    const double now = journal_.seconds();
    if (!first_step_) {
      first_step_ = next_record_ = now;
      journal_.record(progress.steps > 0
                          ? fmt::format("set-up done; {} steps follow", progress.steps)
                          : "set-up done; steps of controlled length follow");
    }
    if (now >= next_record_ + kRecordInterval) {
      journal_.record(progress_line(progress, now - *first_step_));
      next_record_ = now;
    }
    display_.show(progress, now - *first_step_);
    return !interruption_.requested();
  }

 private:
  static constexpr double kRecordInterval = 10;  // of progress in the log [s]

  ProgressDisplay& display_;
  RunJournal& journal_;
  const Interruption& interruption_;
  std::optional<double> first_step_;
  double next_record_ = 0;
};

/// With an option that --continue excludes. @throws InputError
void check_continuation(const RunArguments& arguments) {
  if (arguments.continuation.directory.empty()) {
    if (arguments.continuation.until) {
      throw InputError(
          "--until goes with --continue OUT; elsewhere use --set simulation.duration=T");
    }
    return;
  }
  const auto refuse = [](const char* option, const char* why) {
    throw InputError(fmt::format("--continue and {}: {}; leave out one of them", option, why));
  };
  if (!arguments.out.empty()) refuse("-o", "the results continue in the directory of the run");
  if (arguments.error) refuse("--error", "an error statement needs the whole run");
  if (!arguments.state.start_from.empty()) {
    refuse("--start-from", "a run continues from its own checkpoint");
  }
}

/// The run that a continuation comes to: model, directory and state to start from.
RunArguments completed(RunArguments arguments, const Continuation& from) {
  arguments.out = arguments.continuation.directory;
  if (arguments.model.empty()) arguments.model = from.model().string();
  if (arguments.continuation.until) {
    const auto description = model_file::read_model_file(arguments.model, arguments.overrides);
    if (description.simulation) {
      for (std::string& change : from.changes_until(description, *arguments.continuation.until)) {
        arguments.overrides.push_back(std::move(change));
      }
    }
  }
  arguments.state.start_from = from.checkpoint().string();
  arguments.state.leeway = analysis::Leeway::steps;
  return arguments;
}

/// Runs the model; where an error statement follows, the directory is not completed yet.
/// @param curves gets the sensors on their way to the directory; null: no error statement
results::RunSummary simulate(const model::BuiltModel& built, JournaledSink& sink,
                             analysis::SensorCurves* curves, const RunArguments& arguments,
                             const Interruption& interruption, ProgressDisplay& display,
                             RunJournal& journal) {
  Watch watch(display, journal, interruption);
  const linalg::FactorCache factors(arguments.factors);
  analysis::SimulationOptions options;
  options.stop_reason = "interrupted by the user";
  options.threads = arguments.threads;
  options.on_progress = [&watch](const analysis::Progress& progress) { return watch(progress); };
  results::RecordSink& records =
      curves != nullptr ? static_cast<results::RecordSink&>(*curves) : sink;
  try {
    analysis::Simulation simulation(built, options);
    StateKeeper states(simulation, arguments.state, journal);
    std::optional<analysis::Checkpoints> checkpoints;
    const double interval = built.description.simulation->checkpoint;
    if (interval > 0.0 && curves == nullptr) {
      run_store::RunDirectory& directory = sink.directory();
      checkpoints.emplace(simulation, interval, [&directory](const base::SavedValues& state) {
        directory.write_checkpoint(state);
      });
      directory.checkpoint_at_end([&simulation] { return simulation.save_to_write(); });
    }
    simulation.record_into(records);
    results::RunSummary summary = simulation.run();
    display.clear();
    states.save_end();
    return summary;
  } catch (...) {
    sink.directory().checkpoint_at_end({});
    display.clear();
    if (curves != nullptr && curves->summary()) sink.finish(*curves->summary());
    sink.abandon(describe_failure(std::current_exception()).message);
    if (sink.has_earlier_run_back()) {
      journal.say(LogLevel::warning, fmt::format("the earlier run in {} is as it was",
                                                 arguments.directory().string()));
    }
    if (sink.num_records() > 0) {
      journal.say(
          LogLevel::warning,
          fmt::format("the run ended early; its {} records up to t = {:.6g} s are kept in {}",
                      sink.num_records(), sink.last_time(), arguments.directory().string()));
    }
    throw;
  }
}

void tell_summary(const RunArguments& arguments, bool json, const results::RunSummary& summary,
                  RunJournal& journal) {
  const fs::path path = arguments.directory();
  if (json) {
    print(files::read_text_file(path / run_store::kSummaryName));
  } else if (!arguments.quiet) {
    print(summary_text(summary) + fmt::format("results: {}; look at them with: buckens view {}\n",
                                              path.string(), path.string()));
  } else {
    // The summary that would say so is not shown.
    for (const std::string& text : summary.trust) journal.warn_once(text);
  }
}

/// @throws InputError where there would be nothing to state, or nothing to compare with
void check_error_statement(const RunArguments& arguments,
                           const model::ModelDescription& description) {
  analysis::require_sensors(description);
  if (arguments.state.start_from.empty()) return;
  throw InputError(
      "an error statement repeats the whole run and cannot begin at a saved state; "
      "leave out --start-from or --continue, or --error (`error: off`)");
}

ExitCode run(const RunArguments& given, bool json) {
  check_continuation(given);
  std::optional<Continuation> from;
  if (!given.continuation.directory.empty()) from.emplace(given.continuation.directory);
  const RunArguments arguments = from ? completed(given, *from) : given;
  const bool silent = json || arguments.quiet;
  if (silent) base::set_work_sink({});
  ProgressDisplay display(stderr, silent ? ProgressDisplay::Style::none : style_for(stderr));
  RunJournal journal(display, json              ? LogLevel::error
                              : arguments.quiet ? LogLevel::warning
                                                : LogLevel::info);
  const fs::path path = arguments.directory();
  journal.record(fmt::format("buckens {}, model {}", kVersion, arguments.model));
  for (const std::string& text : arguments.overrides) journal.record("--set " + text);
  auto built = read_model_to_run(arguments);
  // What is wrong with the output is said before an earlier run is replaced.
  analysis::plan_output(built->description);
  arguments.state.check(built->description.simulation->duration);
  const bool has_errors = arguments.error || built->description.simulation->error;
  if (has_errors) check_error_statement(arguments, built->description);

  run_store::RunDirectoryOptions options{built->description.title, built->description.source, {}};
  if (from) options.continues = from->kept();
  run_store::RunDirectory directory(path, std::move(options));
  journal.open(directory);
  journal.say(LogLevel::info, fmt::format("results go to {}", path.string()));
  JournaledSink sink(directory, journal);
  // Said to whoever pressed the key, not into a pipe.
  const Interruption interruption(style_for(stderr) == ProgressDisplay::Style::bar);
  analysis::SensorCurves curves(&sink, analysis::bodies_to_watch(built->description));
  results::RunSummary summary = simulate(*built, sink, has_errors ? &curves : nullptr, arguments,
                                         interruption, display, journal);
  if (has_errors) {
    if (summary.finished) {
      add_error_statement({arguments.model, arguments.overrides, arguments.threads},
                          std::move(built), curves, interruption, display, journal, summary);
    }
    sink.finish(summary);
  }
  tell_summary(arguments, json, summary, journal);
  const bool is_complete = summary.finished && !(summary.errors && !summary.errors->is_complete);
  return is_complete ? ExitCode::ok : ExitCode::interrupted;
}

constexpr char kRunFooter[] = R"(
Example:
  buckens run slider_crank.yaml -o out --set bodies.rod.beam.elements=32
  buckens view out
  buckens run --continue out --until 0.2
  buckens run slider_crank.yaml --save-state half.h5 --save-state-at 0.05
  buckens run slider_crank.yaml -o rest --start-from half.h5

The directory OUT contains results.h5 (everything recorded), sensors.csv (the sensors of the model
file), summary.json (effort, residuals, energy, trust), model.yaml (the model as it was read) and
log.txt. These can be read during the run. An earlier run in OUT is replaced once the set-up of this
one has succeeded; a directory that contains anything else is refused.

With --error (or `error: on` in `simulation`), additional runs each improve one thing: half the step,
a finer mesh, more frames on beams, full coupling, full meshes. From the differences the summary gives
every sensor an uncertainty. This takes several times as long as the run. See
docs/tutorials/error-statement.md.

Ctrl-C (or SIGTERM) finishes the current step and completes the files. A second one ends the program
immediately; at most the last second of results is then missing. `buckens run --continue OUT` resumes
from the checkpoint in OUT, which is written at the end and every 30 s (simulation.checkpoint). The
results are bitwise identical to those of an uninterrupted run.

Exit codes: 0 done, 2 bad input, 3 the model cannot be solved, 4 numerical failure (results up to that
point are kept), 5 files, 130 interrupted. Details: docs/reference/command-line.md)";

}  // namespace

void add_run_verb(CLI::App& program, Invocation& invocation) {
  CLI::App& verb = *program.add_subcommand("run", "Simulate a model and write a run directory");
  const auto arguments = std::make_shared<RunArguments>();
  add_model_options(verb, arguments->model, arguments->overrides);
  verb.add_option("-o,--out", arguments->out,
                  "Directory for the results; by default the model's name with its extension\n"
                  "replaced by .out, in the current directory")
      ->type_name("OUT");
  verb.add_flag(
      "-q,--quiet", arguments->quiet,
      "No progress and no summary; only warnings, reasons to doubt the results and\nerrors");
  verb.add_flag("--error", arguments->error,
                "State how far each sensor may be off, by repeating the run with half the\n"
                "step, finer meshes, and more of what the model reduces");
  verb.add_option("--threads", arguments->threads,
                  "Number of threads, which advance bodies concurrently and share the assembly,\n"
                  "solves and records of large ones; 1 by default. Results are bitwise identical")
      ->check(CLI::Range(1, kMostThreads));
  verb.add_option("--factors", arguments->factors,
                  "Folder in which large factors are kept and looked up: a second run with the\n"
                  "same matrices need not compute them again. Results are bitwise identical")
      ->type_name("DIR");
  add_state_options(verb, arguments->state);
  verb.get_option("MODEL")->required(false);
  add_continuation_options(verb, arguments->continuation);
  add_json_option(verb, invocation);
  verb.footer(kRunFooter);
  verb.callback([arguments, &invocation] {
    if (arguments->model.empty() && arguments->continuation.directory.empty()) {
      throw CLI::ValidationError(
          "MODEL is required, unless --continue OUT names the run to continue");
    }
    invocation.action = [arguments, &invocation] { return run(*arguments, invocation.json); };
  });
}

}  // namespace buckens::cli
