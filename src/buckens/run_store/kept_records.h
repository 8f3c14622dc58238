// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "buckens/base/saved_values.h"
#include "buckens/run_store/run_reader.h"

namespace buckens::run_store {

/// Up to where a continued run keeps the records of the run before it.
struct Continuation {
  double last_record = -1;  ///< time of the last record that stays [s]; negative: none
  double last_fields = -1;  ///< of the last fields over meshes [s]
  double time = 0;          ///< of the checkpoint [s]
  double march_start = 0;   ///< where its grid of steps begins [s]
  double longest_step = 0;  ///< of that grid [s]
  bool is_steered = false;  ///< see mark_steered()
};

/// What a checkpoint says about it. @throws IoError if the saved state is none of a recorded run
Continuation continuation_from(const base::SavedValues& checkpoint);

/// Notes in a checkpoint that functions or values from outside the model act on the run: without
/// them a continuation would be another run.
void mark_steered(base::SavedValues& checkpoint);

/// Takes consecutive rows of a table: their times, and the values of all channels row by row.
using AppendRows = std::function<void(std::span<const double>, std::span<const double>)>;

/// The records that a continued run keeps. It copies them into a new file, so that the old one is
/// whole until the new one can take its place.
class KeptRecords {
 public:
  /// @throws IoError if the results in the directory cannot be read, or end before the last record
  /// that is to be kept
  KeptRecords(const std::filesystem::path& directory, const Continuation& until);

  /// Passes on the records, some megabytes at a time.
  /// @param layout of the continued run: the same channels, in its order
  /// @throws IoError if the results hold other channels
  void copy_records(const results::RecordLayout& layout, const AppendRows& append) const;
  /// The same for fields over meshes. @param layout FieldLayout::fields
  void copy_fields(const results::RecordLayout& layout, const AppendRows& append) const;

 private:
  std::filesystem::path file_;
  RunReader reader_;
  std::vector<double> times_, field_times_;  // of the rows that are kept
};

}  // namespace buckens::run_store
