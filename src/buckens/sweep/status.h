// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "buckens/sweep/shards.h"

namespace buckens::sweep {

/// How far the variants of one shard are; a sweep that is not divided is shard 1 of 1.
struct ShardStatus {
  Shard shard;
  bool has_begun = false;
  bool has_ended = false;  ///< its part of the table is written
  int variants = 0;        ///< known when it has begun
  int finished = 0;        ///< reached their end
  int failed = 0;          ///< ended early
  int running = 0;         ///< or stopped without a word
};

/// How far a sweep is, seen from another process.
struct SweepStatus {
  std::vector<ShardStatus> shards;
  ShardStatus sum;             ///< of all that have begun
  double seconds = 0;          ///< since the first shard has begun [s]
  std::string slowest;         ///< variant that has been running longest; empty: none
  double slowest_seconds = 0;  ///< since it began [s]

  /// Time to the end of the variants that are known, at the rate so far [s]; none without a rate.
  std::optional<double> to_go() const;
};

/// Notes in OUT/.parts/I-of-N.begun which variants a shard is going to run.
/// @throws IoError
void note_beginning(const std::filesystem::path& out, const Shard& shard,
                    const SweepTable& variants);

/// Reads what the shards have noted and the summaries of their variants.
/// @throws InputError if no sweep has begun there, or the shards are of different divisions
SweepStatus read_status(const std::filesystem::path& out);

}  // namespace buckens::sweep
