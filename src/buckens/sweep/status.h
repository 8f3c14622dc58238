// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "buckens/files/output_file.h"
#include "buckens/sweep/shards.h"

namespace buckens::sweep {

/// What a shard notes beside its variants, in OUT/.parts, for those who ask how far it is. A sweep
/// that is not divided is shard 1 of 1.
class ShardNotes {
 public:
  ShardNotes(const std::filesystem::path& out, const Shard& shard, const SweepTable& variants);

  /// Which variants it is going to run. Forgets an earlier run of this shard. From here on no other
  /// process can run it. @throws IoError, also if another process does
  void begin();
  void add_failure(const std::string& variant) const;
  /// That it goes on no more. @throws IoError
  void end() const;

 private:
  std::filesystem::path file(const char* suffix) const;
  void lock();

  std::filesystem::path folder_;
  Shard shard_;
  std::vector<std::string> variants_;
  files::OutputFile lock_;
};

/// How far the variants of one shard are.
struct ShardStatus {
  Shard shard;
  bool has_begun = false;
  bool has_ended = false;  ///< by itself: all variants are finished, failed or interrupted
  int variants = 0;        ///< known when it has begun
  int finished = 0;
  int failed = 0;
  int running = 0;     ///< or killed
  int kept = 0;        ///< those among the finished that were so when it began
  double seconds = 0;  ///< since it began [s]

  bool is_complete() const { return finished + failed >= variants; }
  /// At the rate so far [s]; none while no variant has ended.
  std::optional<double> to_go() const;
};

/// How far a sweep is, seen from another process.
struct SweepStatus {
  std::vector<ShardStatus> shards;
  ShardStatus sum;             ///< of all that have begun
  std::string slowest;         ///< variant that has been running longest; empty: none
  double slowest_seconds = 0;  ///< since it began [s]

  /// Until the last of the shards that have begun ends [s]; none if one of them has no rate yet.
  std::optional<double> to_go() const;
};

/// Reads what the shards have noted and the summaries of their variants.
/// @throws InputError if no sweep has begun there, or the shards are of different divisions
/// @throws IoError if a note is damaged
SweepStatus read_status(const std::filesystem::path& out);

}  // namespace buckens::sweep
