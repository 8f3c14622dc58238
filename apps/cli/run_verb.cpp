// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/build.h"
#include "cli/failure.h"
#include "cli/interruption.h"
#include "cli/journaled_sink.h"
#include "cli/output.h"
#include "cli/progress_display.h"
#include "cli/run_journal.h"
#include "cli/state_keeper.h"
#include "cli/summary_text.h"
#include "cli/verbs.h"

#include "buckens/analysis/output_plan.h"
#include "buckens/analysis/simulation.h"
#include "buckens/base/errors.h"
#include "buckens/base/version.h"
#include "buckens/files/output_file.h"
#include "buckens/model_file/model_file.h"

namespace buckens::cli {

namespace {

namespace fs = std::filesystem;
using base::LogLevel;

constexpr int kMostThreads = 256;

struct RunArguments {
  std::string model, out;
  std::vector<std::string> overrides;
  bool quiet = false;
  int threads = 1;
  StateArguments state;

  fs::path directory() const {
    return out.empty() ? fs::path(model).stem() += ".out" : fs::path(out);
  }
};

std::unique_ptr<model::BuiltModel> read_and_build(const RunArguments& arguments) {
  model::ModelDescription description =
      model_file::read_model_file(arguments.model, arguments.overrides);
  if (!description.simulation) {
    throw InputError(description.where,
                     "there is no `simulation:`, so it is not known how far to simulate. Add for "
                     "instance `simulation: {duration: 1 s, step: 1 ms}`, or use `buckens check`.");
  }
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

results::RunSummary simulate(const model::BuiltModel& built, JournaledSink& sink,
                             const RunArguments& arguments, ProgressDisplay& display,
                             RunJournal& journal) {
  // Said to whoever pressed the key, not into a pipe.
  const Interruption interruption(style_for(stderr) == ProgressDisplay::Style::bar);
  Watch watch(display, journal, interruption);
  analysis::SimulationOptions options;
  options.stop_reason = "interrupted by the user";
  options.threads = arguments.threads;
  options.on_progress = [&watch](const analysis::Progress& progress) { return watch(progress); };
  try {
    analysis::Simulation simulation(built, options);
    StateKeeper states(simulation, arguments.state, journal);
    simulation.record_into(sink);
    results::RunSummary summary = simulation.run();
    display.clear();
    states.save_end();
    return summary;
  } catch (...) {
    display.clear();
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

ExitCode run(const RunArguments& arguments, bool json) {
  const bool silent = json || arguments.quiet;
  ProgressDisplay display(stderr, silent ? ProgressDisplay::Style::none : style_for(stderr));
  RunJournal journal(display, json              ? LogLevel::error
                              : arguments.quiet ? LogLevel::warning
                                                : LogLevel::info);
  const fs::path path = arguments.directory();
  journal.record(fmt::format("buckens {}, model {}", kVersion, arguments.model));
  for (const std::string& text : arguments.overrides) journal.record("--set " + text);
  const auto built = read_and_build(arguments);
  // What is wrong with the output is said before an earlier run is replaced.
  if (built->description.simulation) {
    analysis::plan_output(built->description);
    arguments.state.check(built->description.simulation->duration);
  }

  run_store::RunDirectory directory(path,
                                    {built->description.title, built->description.source, {}});
  journal.open(directory);
  journal.say(LogLevel::info, fmt::format("results go to {}", path.string()));
  JournaledSink sink(directory, journal);
  const results::RunSummary summary = simulate(*built, sink, arguments, display, journal);

  if (json) {
    print(files::read_text_file(path / run_store::kSummaryName));
  } else if (!arguments.quiet) {
    print(summary_text(summary) + fmt::format("results: {}; look at them with: buckens view {}\n",
                                              path.string(), path.string()));
  } else {
    // The summary that would say so is not shown.
    for (const std::string& text : summary.trust) journal.warn_once(text);
  }
  return summary.finished ? ExitCode::ok : ExitCode::interrupted;
}

constexpr char kRunFooter[] = R"(
Example:
  buckens run slider_crank.yaml -o out --set bodies.rod.beam.elements=32
  buckens view out
  buckens run slider_crank.yaml --save-state half.h5 --save-state-at 0.05
  buckens run slider_crank.yaml -o rest --start-from half.h5

The directory OUT holds results.h5 (everything recorded), sensors.csv (the sensors of the model
file), summary.json (effort, residuals, energy, trust), model.yaml (the model as it was read) and
log.txt. It can be read while the run goes on. An earlier run in OUT is replaced once the set-up of
this one has succeeded; a directory that holds anything else is refused.

Ctrl-C (or SIGTERM) finishes the current step and completes the files; a second one ends the program
at once, and then at most the last second of results is missing.

Exit codes: 0 done, 2 bad input, 3 the model cannot be solved, 4 numerical failure (results up to it
are kept), 5 files, 130 interrupted. Details: docs/reference/command-line.md)";

}  // namespace

void add_run_verb(CLI::App& program, Invocation& invocation) {
  CLI::App& verb = *program.add_subcommand("run", "Simulate a model and write a run directory");
  const auto arguments = std::make_shared<RunArguments>();
  add_model_options(verb, arguments->model, arguments->overrides);
  verb.add_option("-o,--out", arguments->out,
                  "Directory for the results; without it the model's name with .out in\n"
                  "place of its ending, in the current directory")
      ->type_name("OUT");
  verb.add_flag(
      "-q,--quiet", arguments->quiet,
      "No progress and no summary; warnings, reasons to doubt the results and\nerrors only");
  verb.add_option("--threads", arguments->threads,
                  "Threads that advance bodies at the same time, two of them also one large\n"
                  "body; 1 if not given. Results are the same to the last bit")
      ->check(CLI::Range(1, kMostThreads));
  add_state_options(verb, arguments->state);
  add_json_option(verb, invocation);
  verb.footer(kRunFooter);
  verb.callback([arguments, &invocation] {
    invocation.action = [arguments, &invocation] { return run(*arguments, invocation.json); };
  });
}

}  // namespace buckens::cli
