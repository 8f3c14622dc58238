// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/interruption.h"
#include "cli/output.h"
#include "cli/progress_display.h"
#include "cli/sweep_status.h"
#include "cli/text_table.h"
#include "cli/verbs.h"

#include "buckens/base/errors.h"
#include "buckens/base/work.h"
#include "buckens/files/output_file.h"
#include "buckens/sweep/parts.h"
#include "buckens/sweep/shards.h"
#include "buckens/sweep/status.h"
#include "buckens/sweep/summary.h"
#include "buckens/sweep/table.h"
#include "buckens/sweep/variant_runs.h"

namespace buckens::cli {

namespace {

namespace fs = std::filesystem;

struct SweepArguments {
  std::string model, table, out;
  std::vector<std::string> overrides, ranges;
  std::string shard, merge, status;
  int together = sweep::SweepOptions{}.together;
  bool quiet = false;

  fs::path directory() const {
    return out.empty() ? fs::path(model).stem() += ".sweep" : fs::path(out);
  }
};

sweep::SweepTable variants_of(const SweepArguments& arguments) {
  if (arguments.table.empty() == arguments.ranges.empty()) {
    throw InputError({},
                     "a sweep needs variants: either a CSV table, `buckens sweep MODEL TABLE`, or "
                     "ranges, `--vary PATH=[VALUE, ...]`, but not both");
  }
  return arguments.table.empty() ? sweep::combinations(arguments.ranges)
                                 : sweep::read_sweep_table(arguments.table);
}

/// Tells the user about every variant that ends, and now and then how far the others are.
class SweepDisplay {
 public:
  explicit SweepDisplay(bool quiet) : quiet_(quiet) {}

  void show(const sweep::SweepProgress& progress) {
    const double now = seconds();
    if (progress.ended != nullptr && (!quiet_ || is_failure(*progress.ended))) {
      const std::string why = progress.ended->message.empty() ? "" : ": " + progress.ended->message;
      say(fmt::format("{} {}{} ({} of {}, ETA {})", progress.ended->name,
                      sweep::to_string(progress.ended->status), why, progress.num_ended,
                      progress.num_variants, time_to_go(progress.share)));
    } else if (!quiet_ && now > next_) {
      say(fmt::format("{:.0f} % of all steps, ETA {}", 100 * progress.share,
                      time_to_go(progress.share)));
    } else {
      return;
    }
    next_ = now + kInterval;
  }

 private:
  static constexpr double kInterval = 10;  // between lines that only say how far [s]

  static bool is_failure(const sweep::VariantOutcome& variant) {
    return variant.status == sweep::VariantStatus::failed;
  }
  static void say(const std::string& line) { tell(stderr, line + '\n'); }
  std::string time_to_go(double share) const {
    return clock_text(share > 0 ? seconds() * (1 - share) / share : -1);
  }
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  bool quiet_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double next_ = kInterval;
};

std::string outcome_text(const sweep::SweepOutcome& outcome, const fs::path& table) {
  const auto count = [&](sweep::VariantStatus status) {
    return std::count_if(outcome.variants.begin(), outcome.variants.end(),
                         [&](const auto& variant) { return variant.status == status; });
  };
  std::string text =
      fmt::format("{}: {} done, {} kept from before, {} failed, {} not finished\n",
                  counted(static_cast<long>(outcome.variants.size()), "variant"),
                  count(sweep::VariantStatus::done), count(sweep::VariantStatus::kept),
                  count(sweep::VariantStatus::failed), count(sweep::VariantStatus::interrupted));
  if (outcome.passes > 0) {
    text += fmt::format("large bodies: {}, {} in {} passes over a factor\n",
                        counted(outcome.factorisations, "factorisation"),
                        counted(outcome.solves, "solve"), outcome.passes);
  }
  return text + fmt::format("table: {}\n", table.string());
}

nlohmann::ordered_json outcome_json(const sweep::SweepOutcome& outcome, const fs::path& directory,
                                    const fs::path& table) {
  nlohmann::ordered_json variants = nlohmann::ordered_json::array();
  for (const sweep::VariantOutcome& variant : outcome.variants) {
    variants.push_back({{"name", variant.name},
                        {"status", sweep::to_string(variant.status)},
                        {"directory", (directory / variant.name).string()}});
    if (!variant.message.empty()) variants.back()["message"] = variant.message;
  }
  return {{"table", table.string()},
          {"variants", std::move(variants)},
          {"factorisations", outcome.factorisations},
          {"solves", outcome.solves},
          {"passes", outcome.passes}};
}

ExitCode exit_code_of(const std::vector<sweep::VariantOutcome>& variants) {
  const auto any = [&](sweep::VariantStatus status) {
    return std::any_of(variants.begin(), variants.end(),
                       [&](const auto& variant) { return variant.status == status; });
  };
  if (any(sweep::VariantStatus::interrupted)) return ExitCode::interrupted;
  return any(sweep::VariantStatus::failed) ? ExitCode::numerical : ExitCode::ok;
}

void write_table(const fs::path& directory, const sweep::SummaryTable& summary) {
  files::replace_text_file(directory / sweep::kSweepName, summary.csv());
  summary.write_hdf5(directory / sweep::kSweepHdf5Name);
}

void tell_outcome(const SweepArguments& arguments, const sweep::SweepOutcome& outcome,
                  const fs::path& table, bool json) {
  if (json) {
    print(to_text(outcome_json(outcome, arguments.directory(), table)));
  } else if (!arguments.quiet) {
    print(outcome_text(outcome, table));
  }
}

sweep::SweepOutcome run(const SweepArguments& arguments, const sweep::SweepTable& variants,
                        sweep::ShardNotes& notes, bool json) {
  const Interruption interruption(style_for(stderr) == ProgressDisplay::Style::bar);
  SweepDisplay display(arguments.quiet || json);
  sweep::SweepOptions options;
  options.together = arguments.together;
  options.on_begin = [&] { notes.begin(); };
  options.on_progress = [&](const sweep::SweepProgress& progress) {
    display.show(progress);
    const sweep::VariantOutcome* ended = progress.ended;
    if (ended != nullptr && ended->status == sweep::VariantStatus::failed) {
      notes.add_failure(ended->name);
    }
    return !interruption.requested();
  };
  return sweep::run_variants(arguments.model, arguments.overrides, variants, arguments.directory(),
                             options);
}

/// One shard: its variants, and its part of the table.
ExitCode run_shard(const SweepArguments& arguments, const sweep::SweepTable& table, bool json) {
  const sweep::Shard shard = sweep::parse_shard(arguments.shard);
  const fs::path directory = arguments.directory();
  const std::string study = sweep::study_of(arguments.model, arguments.overrides, table);
  const std::vector<int> groups = sweep::matrix_groups(arguments.model, arguments.overrides, table);
  const auto shards = sweep::divide_into_shards(groups, shard.count);
  const std::vector<std::size_t>& mine = shards[static_cast<std::size_t>(shard.index) - 1];
  const sweep::SweepTable variants = sweep::selected(table, mine);
  sweep::ShardNotes notes(directory, shard, variants);
  const sweep::SweepOutcome outcome = run(arguments, variants, notes, json);
  sweep::write_part(directory, shard, study, mine,
                    sweep::sweep_summary(directory, variants, outcome), outcome.variants);
  notes.end();
  tell_outcome(arguments, outcome, directory / sweep::kPartsName / (shard.name() + ".json"), json);
  return exit_code_of(outcome.variants);
}

/// @throws InputError if there is more than --merge or --status
void require_alone(const SweepArguments& arguments, const char* option) {
  const bool has_more = !arguments.model.empty() || !arguments.table.empty() ||
                        !arguments.ranges.empty() || !arguments.shard.empty() ||
                        !arguments.out.empty() || !arguments.overrides.empty() ||
                        (!arguments.merge.empty() && !arguments.status.empty());
  if (!has_more) return;
  throw InputError({}, fmt::format("`buckens sweep {} OUT` takes nothing but the directory of the "
                                   "sweep",
                                   option));
}

ExitCode status(const SweepArguments& arguments, bool json) {
  require_alone(arguments, "--status");
  const sweep::SweepStatus found = sweep::read_status(arguments.status);
  print(json ? status_json(found) : status_text(found));
  return ExitCode::ok;
}

ExitCode merge(const SweepArguments& arguments, bool json) {
  require_alone(arguments, "--merge");
  const fs::path directory = arguments.merge;
  const sweep::MergedSweep merged = sweep::merge_parts(directory);
  write_table(directory, merged.summary);
  SweepArguments told = arguments;
  told.out = arguments.merge;
  tell_outcome(told, {merged.variants}, directory / sweep::kSweepName, json);
  return exit_code_of(merged.variants);
}

ExitCode sweep(const SweepArguments& arguments, bool json) {
  if (arguments.quiet) base::set_work_sink({});
  if (!arguments.status.empty()) return status(arguments, json);
  if (!arguments.merge.empty()) return merge(arguments, json);
  if (arguments.model.empty()) {
    throw InputError({}, "MODEL is required: `buckens sweep MODEL TABLE`, or `--merge OUT`");
  }
  const sweep::SweepTable variants = variants_of(arguments);
  if (!arguments.shard.empty()) return run_shard(arguments, variants, json);
  const fs::path directory = arguments.directory();
  sweep::ShardNotes notes(directory, {}, variants);
  const sweep::SweepOutcome outcome = run(arguments, variants, notes, json);
  write_table(directory, sweep::sweep_summary(directory, variants, outcome));
  notes.end();
  tell_outcome(arguments, outcome, directory / sweep::kSweepName, json);
  return exit_code_of(outcome.variants);
}

constexpr char kSweepFooter[] = R"(
Example:
  buckens sweep slider_crank.yaml variants.csv -o speeds
  buckens sweep slider_crank.yaml --vary "parameters.speed=[100, 125, 150]" -o speeds

TABLE is a CSV file. Its first line names quantities of the model file as in --set, and every other
line is a variant; the column `name` names the run directories. Put values that contain commas in
double quotes: "[36, 2, 2]". With several --vary, all combinations are run.

Each variant becomes the run directory OUT/NAME. OUT/sweep.csv has one row per variant with effort,
energy error, trust, and the last value and extremes of every sensor. Variants whose bodies have
equal matrices advance side by side: one factorisation serves all, and their solves read it once.

With --shard I/N this process runs the I-th of N parts of the table, for example as a task of a job
array; variants that share factors stay together. When all parts are finished, `buckens sweep --merge
OUT` writes the table. A shard can be started again and keeps what is finished. `--status OUT` reports
the progress of all shards from any process that can see the directory.

A variant that fails does not stop the others. Ctrl-C ends the sweep after the current steps; running
the same command later keeps what is finished and runs the rest.

Exit codes: 0 all done, 2 bad input, 4 some variants failed, 5 files, 130 interrupted.
Details: docs/tutorials/sweeps.md)";

}  // namespace

void add_sweep_verb(CLI::App& program, Invocation& invocation) {
  CLI::App& verb = *program.add_subcommand("sweep", "Simulate variants of a model side by side");
  const auto arguments = std::make_shared<SweepArguments>();
  add_model_options(verb, arguments->model, arguments->overrides);
  verb.get_option("MODEL")->required(false);
  verb.add_option("TABLE", arguments->table, "Table of variants (CSV)");
  verb.add_option("--vary", arguments->ranges, "Values of one quantity; may be repeated")
      ->type_name("PATH=[VALUE,...]")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  verb.add_option("-o,--out", arguments->out,
                  "Directory for the runs; by default the model's name with its extension\n"
                  "replaced by .sweep, in the current directory")
      ->type_name("OUT");
  verb.add_option("--together", arguments->together,
                  "Maximum number of variants that advance side by side")
      ->capture_default_str()
      ->check(CLI::Range(1, 32));
  verb.add_option("--shard", arguments->shard, "Only the I-th of N parts of the variants")
      ->type_name("I/N");
  verb.add_option("--merge", arguments->merge, "Write the table from the parts in OUT")
      ->type_name("OUT");
  verb.add_option("--status", arguments->status, "Report the progress of the sweep in OUT")
      ->type_name("OUT");
  verb.add_flag("-q,--quiet", arguments->quiet, "Show failures only");
  add_json_option(verb, invocation);
  verb.footer(kSweepFooter);
  verb.callback([arguments, &invocation] {
    invocation.action = [arguments, &invocation] { return sweep(*arguments, invocation.json); };
  });
}

}  // namespace buckens::cli
