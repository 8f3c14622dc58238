// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "buckens/sweep/shards.h"
#include "buckens/sweep/summary_table.h"
#include "buckens/sweep/variant_runs.h"

namespace buckens::sweep {

/// Folder of the parts below the directory of a sweep. No variant can have this name.
inline constexpr char kPartsName[] = ".parts";

/// What must be equal for parts to belong together: a hash over model and table.
std::string study_of(const std::filesystem::path& model, const std::vector<std::string>& overrides,
                     const SweepTable& table);

/// Writes the rows of one shard to OUT/.parts/I-of-N.json: the whole file or nothing.
/// @param variants indices in the whole table of the rows of `summary`
/// @param outcomes of these variants
/// @throws IoError
void write_part(const std::filesystem::path& out, const Shard& shard, const std::string& study,
                const std::vector<std::size_t>& variants, const SummaryTable& summary,
                const std::vector<VariantOutcome>& outcomes);

/// A sweep put together from its parts.
struct MergedSweep {
  SummaryTable summary;                  ///< in the order of the table
  std::vector<VariantOutcome> variants;  ///< the same
  int shards = 0;
};

/// @throws InputError if parts are missing (naming them), belong to different sweeps or to
/// divisions into different numbers of shards, or have read a file with different contents;
/// IoError if one cannot be read or is damaged
MergedSweep merge_parts(const std::filesystem::path& out);

}  // namespace buckens::sweep
