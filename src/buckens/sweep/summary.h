// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "buckens/sweep/table.h"
#include "buckens/sweep/variant_runs.h"

namespace buckens::sweep {

/// Name of the table in the directory of a sweep.
inline constexpr char kSweepName[] = "sweep.csv";

/// The table of a sweep in CSV: for each variant its values, how it ended, effort and trust, and
/// for every sensor the last value and the extremes over time. Unknown cells are empty.
/// @param out directory of the sweep; finished runs are read from there
std::string sweep_summary_csv(const std::filesystem::path& out, const SweepTable& table,
                              const SweepOutcome& outcome);

}  // namespace buckens::sweep
