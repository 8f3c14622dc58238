// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "buckens/base/saved_values.h"
#include "buckens/files/output_file.h"
#include "buckens/results/record_sink.h"
#include "buckens/run_store/earlier_run.h"
#include "buckens/run_store/hdf5_recorder.h"
#include "buckens/run_store/kept_records.h"
#include "buckens/run_store/run_files.h"
#include "buckens/run_store/sensors_csv.h"

namespace buckens::run_store {

struct RunDirectoryOptions {
  std::string title;       ///< of the model
  std::string model_text;  ///< contents of model.yaml: the model as read
  FlushRule flush;
  /// Whether an earlier run is restored if this one ends before begin().
  bool keeps_earlier_run = true;
  /// The run goes on from the checkpoint in the directory; none: it begins anew.
  std::optional<Continuation> continues = std::nullopt;
};

/// The directory with all the output of a run. Layout:
/// docs/reference/run-directory.md.
///
/// It can be read during the run and after SIGKILL at any moment; at most the records of the last
/// second are then missing. One process at a time writes into a directory.
class RunDirectory : public results::RecordSink {
 public:
  /// Creates the directory and its parents, or takes over that of an earlier run. Its results are
  /// removed by begin(), or restored if this run ends without it. Other files are kept. A
  /// continued run changes nothing before begin(), which cuts the results back to the checkpoint.
  /// @throws IoError if the directory contains other things than a run, another run is writing into
  /// it, or it cannot be written
  explicit RunDirectory(std::filesystem::path path, RunDirectoryOptions options = {});
  /// Without a call of `finish` the run counts as interrupted.
  ~RunDirectory() override;

  /// Creates results.h5 and sensors.csv. @throws IoError
  void begin(const results::RecordLayout& layout, const results::Geometry& geometry) override;
  /// @throws IoError: from then on nothing more is recorded, what was written stays readable
  void write(const results::Record& record) override;
  /// Completes all files; summary.json even if completing another one fails. Before begin() an
  /// earlier run with results is restored instead.
  /// @throws IoError unless `write` has thrown the same before
  void finish(const results::RunSummary& summary) override;
  void begin_fields(const results::FieldLayout& layout) override;
  /// @throws IoError as write()
  void write_fields(const results::Record& fields) override;
  void write_extremes(const std::vector<double>& values) override;

  /// Brings the records so far to the file, where readers find them; else they come within a
  /// second.
  /// @throws IoError as write()
  void flush();
  /// Writes checkpoint.h5, after the records so far have been brought to the disk: a continuation
  /// from it finds all records up to its state, whatever happens later. A checkpoint that cannot be
  /// written leaves the one before in place, and is a warning in the log.
  /// @throws IoError as write(), if records cannot be written
  void write_checkpoint(const base::SavedValues& state);
  /// `state` is asked by finish() for a last checkpoint, unless writing has failed or there are no
  /// records. Null: none.
  void checkpoint_at_end(std::function<base::SavedValues()> state) {
    last_state_ = std::move(state);
  }

  /// Appends lines to log.txt; a line break is added at the end. @throws IoError
  void log(std::string_view lines);

  const std::filesystem::path& path() const { return path_; }
  bool is_complete() const { return finished_; }  ///< `finish` has been called
  /// An earlier run was restored or left alone, because this one ended before begin().
  bool has_earlier_run_back() const { return has_earlier_run_back_; }

 private:
  void take_directory();
  void take_up();
  void write_first_files();
  void lock();
  void go_on_recording(const results::RecordLayout& layout, const results::Geometry& geometry);
  void try_checkpoint(const base::SavedValues& state);
  void write_status(std::string_view json) const;
  void guarded(const std::function<void()>& work);

  std::filesystem::path path_;
  RunDirectoryOptions options_;
  std::string started_;
  files::OutputFile log_;  // its lock marks the directory as taken
  EarlierRun earlier_;
  files::WriteProcess writer_;  // outlives the recorder, as does the next
  Hdf5Undo undo_{path_};
  SensorsCsv sensors_;
  std::unique_ptr<Hdf5Recorder> recorder_;
  std::optional<results::FieldLayout> fields_;
  std::unique_ptr<KeptRecords> kept_;  // of the run that is continued, until begin()
  std::function<base::SavedValues()> last_state_;
  std::size_t num_values_ = 0;
  double last_time_ = 0;
  std::string failure_;  // why recording ended early
  bool finished_ = false;
  bool has_earlier_run_back_ = false;
};

}  // namespace buckens::run_store
