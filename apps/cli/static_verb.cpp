// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>
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
#include "cli/summary_text.h"
#include "cli/verbs.h"

#include "buckens/analysis/statics/path.h"
#include "buckens/base/version.h"
#include "buckens/base/work.h"
#include "buckens/files/output_file.h"

namespace buckens::cli {

namespace {

namespace fs = std::filesystem;
using base::LogLevel;

constexpr char kStopped[] = "interrupted by the user";

struct StaticArguments {
  std::string model, out;
  std::vector<std::string> overrides;
  bool quiet = false;

  fs::path directory() const {
    return out.empty() ? fs::path(model).stem() += ".static.out" : fs::path(out);
  }
};

results::RunSummary trace(const model::BuiltModel& built, JournaledSink& sink,
                          const fs::path& directory, RunJournal& journal) {
  const Interruption interruption(style_for(stderr) == ProgressDisplay::Style::bar);
  analysis::StaticPathOptions options;
  options.stop_reason = kStopped;
  options.on_progress = [&](const analysis::StaticProgress& progress) {
    journal.record(fmt::format("point {}: load factor {:.9g}, step {:.3g}, {} iterations",
                               progress.point, progress.load_factor, progress.step,
                               progress.iterations));
    return !interruption.requested();
  };
  try {
    return analysis::trace_static_path(built, sink, options);
  } catch (...) {
    sink.abandon(describe_failure(std::current_exception()).message);
    if (sink.has_earlier_run_back()) {
      journal.say(LogLevel::warning,
                  fmt::format("the earlier run in {} is as it was", directory.string()));
    }
    if (sink.num_records() > 0) {
      journal.say(LogLevel::warning,
                  fmt::format("the path ended early; its {} points are kept in {}",
                              sink.num_records(), directory.string()));
    }
    throw;
  }
}

ExitCode run(const StaticArguments& arguments, bool json) {
  if (arguments.quiet) base::set_work_sink({});
  ProgressDisplay display(stderr, ProgressDisplay::Style::none);
  RunJournal journal(display, json              ? LogLevel::error
                              : arguments.quiet ? LogLevel::warning
                                                : LogLevel::info);
  const fs::path path = arguments.directory();
  journal.record(fmt::format("buckens {}, static path of {}", kVersion, arguments.model));
  for (const std::string& text : arguments.overrides) journal.record("--set " + text);
  const auto built = read_and_build(arguments.model, arguments.overrides);
  for (const std::string& text : built->model.notes) journal.say(LogLevel::info, text);

  run_store::RunDirectory directory(path,
                                    {built->description.title, built->description.source, {}});
  journal.open(directory);
  journal.say(LogLevel::info, fmt::format("results go to {}", path.string()));
  JournaledSink sink(directory, journal);
  const results::RunSummary summary = trace(*built, sink, path, journal);

  if (json) {
    print(files::read_text_file(path / run_store::kSummaryName));
  } else if (!arguments.quiet) {
    print(summary_text(summary) + fmt::format("results: {}; look at them with: buckens view {}\n",
                                              path.string(), path.string()));
  } else {
    // The summary that would say so is not shown.
    for (const std::string& text : summary.trust) journal.warn_once(text);
  }
  if (summary.finished) return ExitCode::ok;
  return summary.interrupted == kStopped ? ExitCode::interrupted : ExitCode::numerical;
}

constexpr char kStaticFooter[] = R"(
Example:
  buckens static examples/snap_through/snap_through.yaml -o path
  buckens view path

The applied forces and torques of the model are multiplied by a load factor that goes from 0 to 1, or
as `static:` in the model file says; gravity, springs and drives are not scaled. With `method:
arc-length` the path is followed through limit points, beyond which the load has to fall. Limit points
and bifurcations are located and reported.

OUT is a run directory like that of `buckens run`. Its time is the length of the path in steps; the
next column of sensors.csv, `load-factor`, is the load factor.

Exit codes: 0 done, 2 bad input, 3 a mechanism or no equilibrium, 4 the end of the path was not reached
(its points are kept), 5 files, 130 interrupted. Details: docs/reference/command-line.md)";

}  // namespace

void add_static_verb(CLI::App& program, Invocation& invocation) {
  CLI::App& verb = *program.add_subcommand(
      "static", "Trace equilibria over a load factor, through limit points");
  const auto arguments = std::make_shared<StaticArguments>();
  add_model_options(verb, arguments->model, arguments->overrides);
  verb.add_option("-o,--out", arguments->out,
                  "Directory for the results; by default the model's name with its extension\n"
                  "replaced by .static.out, in the current directory")
      ->type_name("OUT");
  verb.add_flag("-q,--quiet", arguments->quiet,
                "No summary; only warnings, reasons to doubt the results and errors");
  add_json_option(verb, invocation);
  verb.footer(kStaticFooter);
  verb.callback([arguments, &invocation] {
    invocation.action = [arguments, &invocation] { return run(*arguments, invocation.json); };
  });
}

}  // namespace buckens::cli
