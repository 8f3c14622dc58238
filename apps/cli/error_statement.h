// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cli/interruption.h"
#include "cli/progress_display.h"
#include "cli/run_journal.h"

#include "buckens/analysis/error/sensor_curves.h"
#include "buckens/model/build/build_model.h"

namespace buckens::cli {

/// Input of an error statement besides the run.
struct ErrorStatementInput {
  std::string model;                   ///< the file, read again if a part is remeshed
  std::vector<std::string> overrides;  ///< of the run
  int threads = 1;
};

/// Does the further runs of an error statement and adds it to the summary, including its effect on
/// `trust`.
/// @param built of the run; freed before the further runs begin
/// @param curves sensors of the run, finished
void add_error_statement(const ErrorStatementInput& input, std::unique_ptr<model::BuiltModel> built,
                         const analysis::SensorCurves& curves, const Interruption& interruption,
                         ProgressDisplay& display, RunJournal& journal,
                         results::RunSummary& summary);

}  // namespace buckens::cli
