// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/run_journal.h"

#include "buckens/results/record_sink.h"
#include "buckens/run_store/run_directory.h"

namespace buckens::cli {

/// Passes records on to a run directory, counts them, prints warnings that are known only at the
/// end, and adds the summary to the log before the directory is completed.
class JournaledSink : public results::RecordSink {
 public:
  JournaledSink(run_store::RunDirectory& directory, RunJournal& journal)
      : directory_(directory), journal_(journal) {}

  void begin(const results::RecordLayout& layout, const results::Geometry& geometry) override;
  void write(const results::Record& record) override;
  void finish(const results::RunSummary& summary) override;
  void begin_fields(const results::FieldLayout& layout) override;
  void write_fields(const results::Record& fields) override { directory_.write_fields(fields); }
  void write_extremes(const std::vector<double>& values) override {
    directory_.write_extremes(values);
  }

  /// Completes the directory of a run that failed, if the simulation has not done so: `reason` is
  /// given in its summary. Never throws, since the user must see the failure itself.
  void abandon(const std::string& reason) noexcept;

  /// The run ended before its first record, and an earlier one in the directory was restored.
  bool has_earlier_run_back() const { return directory_.has_earlier_run_back(); }
  run_store::RunDirectory& directory() { return directory_; }
  long num_records() const { return num_records_; }
  double last_time() const { return last_time_; }  ///< of a record [s]

 private:
  run_store::RunDirectory& directory_;
  RunJournal& journal_;
  long num_records_ = 0;
  double last_time_ = 0;
  bool finished_ = false;
};

}  // namespace buckens::cli
