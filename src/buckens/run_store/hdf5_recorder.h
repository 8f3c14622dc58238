// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <exception>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "buckens/results/record_sink.h"
#include "buckens/run_store/hdf5_extremes.h"
#include "buckens/run_store/hdf5_file.h"
#include "buckens/run_store/hdf5_table.h"
#include "buckens/run_store/kept_records.h"

namespace buckens::run_store {

/// How long records may wait before they are passed to the system.
struct FlushRule {
  std::size_t records = 100;
  /// Half of the second that may be lost, leaving the other half for writing itself.
  std::chrono::milliseconds age{500};
  /// More waiting bytes than this are written regardless of the number of records.
  std::size_t bytes = 16U << 20U;
  /// A record of more bytes does not wait: it would be held once more, and again while it is
  /// written.
  std::size_t bytes_at_once = 1U << 20U;
};

/// Rows that stand in results.h5 before those of the run: each function passes them on.
struct EarlierRows {
  std::function<void(const AppendRows&)> records, fields;
};

/// Writes results.h5 during a run.
///
/// Records are collected in memory and written to the file by the flush rule: the count is checked
/// at each `write`, the age by a separate thread, so that the rule also holds during a long step.
/// The file appears under its name once it can be read.
class Hdf5Recorder {
 public:
  /// @param writer  carries out the writes; must outlive this
  /// @param undo  keeps what is overwritten after a checkpoint; must outlive this; may be null
  /// @param title, version  attributes of the file
  /// @param checkpoint  to which the earlier rows belong, for `undo`
  /// @param earlier  null: none; with them the file is on the disk before it replaces another one
  /// @param fields  null: the run has none
  /// @throws IoError
  Hdf5Recorder(const std::filesystem::path& path, files::WriteProcess& writer,
               const results::RecordLayout& layout, const results::Geometry& geometry,
               const results::FieldLayout* fields, const std::string& title,
               const std::string& version, const FlushRule& rule, Hdf5Undo* undo = nullptr,
               const EarlierRows* earlier = nullptr, const std::string& checkpoint = {});
  /// Writes what is waiting, as far as possible.
  ~Hdf5Recorder();
  Hdf5Recorder(const Hdf5Recorder&) = delete;
  Hdf5Recorder& operator=(const Hdf5Recorder&) = delete;

  /// @throws IoError, also for errors of the flushing thread since the last call; the file then
  /// keeps what was flushed before, and every further call throws the same
  void write(const results::Record& record);
  /// A record of fields. @throws IoError as write()
  void write_fields(const results::Record& fields);
  /// Replaces the largest values so far. @throws IoError as write()
  void write_extremes(const std::vector<double>& values);
  /// Passes what is waiting to the system. @throws IoError as write()
  void flush();
  /// To be called when the file is on the disk, and the checkpoint that goes with it.
  void begin_undo(const std::string& checkpoint);
  /// Writes what is waiting and completes the file. @throws IoError
  void close();

 private:
  void take_earlier(const EarlierRows& earlier, bool has_fields);
  bool is_large(const results::Record& record) const;
  void note_age();
  void flush_waiting();
  void guarded(const std::function<void()>& work);
  void watch_age();
  void stop_thread();
  void rethrow_failure() const;

  FlushRule rule_;
  Hdf5Undo* undo_;
  Hdf5File file_;
  Hdf5Table table_, fields_;
  Hdf5Extremes extremes_;

  std::mutex mutex_;  // guards all below, file_ and table_
  std::condition_variable changed_;
  std::vector<double> times_, values_, field_times_, field_values_;
  std::chrono::steady_clock::time_point oldest_;
  std::exception_ptr failure_;
  bool stopping_ = false;
  std::thread thread_;  // last: starts when everything else is constructed
};

}  // namespace buckens::run_store
