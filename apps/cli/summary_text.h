// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "buckens/results/run_summary.h"

namespace buckens::cli {

/// The summary of a run for people: effort, residuals, energy, wall time, trust, warnings.
std::string summary_text(const results::RunSummary& summary);

/// The summary of a static path: points, critical points, residuals, trust, warnings.
std::string static_path_text(const results::RunSummary& summary);

}  // namespace buckens::cli
