// SPDX-License-Identifier: Apache-2.0
#include "cli/error_statement.h"

#include <utility>

#include <fmt/format.h>

#include "buckens/analysis/error/runs.h"
#include "buckens/base/log.h"
#include "buckens/model_file/model_file.h"

namespace buckens::cli {

namespace {

/// The model with parts of STEP files meshed with elements of other sizes.
analysis::Remesh remesh_from(const ErrorStatementInput& input) {
  return [&input](const std::vector<std::pair<std::string, double>>& bodies) {
    std::vector<std::string> overrides = input.overrides;
    for (const auto& [body, size] : bodies) {
      overrides.push_back(fmt::format("bodies.{}.geometry.size={:.9g}", body, size));
    }
    return model_file::read_model_file(input.model, overrides);
  };
}

}  // namespace

void add_error_statement(const ErrorStatementInput& input, std::unique_ptr<model::BuiltModel> built,
                         const analysis::SensorCurves& curves, const Interruption& interruption,
                         ProgressDisplay& display, RunJournal& journal,
                         results::RunSummary& summary) {
  const analysis::ErrorVariants variants =
      analysis::error_variants(*built, curves, remesh_from(input));
  built.reset();
  double begin = 0;
  analysis::ErrorRunOptions options;
  options.threads = input.threads;
  options.on_begin = [&](const results::ErrorSource& source, std::size_t k, std::size_t count) {
    display.clear();
    journal.say(base::LogLevel::info, fmt::format("error statement, run {} of {}: {} ({})", k + 1,
                                                  count, source.name, source.what));
    begin = journal.seconds();
  };
  options.on_progress = [&](const analysis::Progress& progress) {
    display.show(progress, journal.seconds() - begin);
    return !interruption.requested();
  };
  summary.errors = analysis::state_errors(variants, curves, options);
  display.clear();
  for (std::string& reason : analysis::doubts(*summary.errors)) {
    summary.trust.push_back(std::move(reason));
  }
}

}  // namespace buckens::cli
