// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/hdf5_recorder.h"

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/files/output_file.h"
#include "buckens/results/motion_tables.h"
#include "buckens/run_store/hdf5_geometry.h"
#include "buckens/run_store/hdf5_values.h"

namespace buckens::run_store {

namespace {

constexpr int kResultsFormat = 1;

std::filesystem::path unfinished(std::filesystem::path path) {
  path += ".part";
  return path;
}

}  // namespace

Hdf5Recorder::Hdf5Recorder(const std::filesystem::path& path, files::WriteProcess& writer,
                           const results::RecordLayout& layout, const results::Geometry& geometry,
                           const results::FieldLayout* fields, const std::string& title,
                           const std::string& version, const FlushRule& rule, Hdf5Undo* undo,
                           const EarlierRows* earlier, const std::string& checkpoint)
    : rule_(rule), undo_(undo), file_(Hdf5File::create(unfinished(path), writer, undo)) {
  try {
    write_attribute(file_, "/", "program", std::string("buckens"));
    write_attribute(file_, "/", "format", kResultsFormat);
    write_attribute(file_, "/", "version", version);
    write_attribute(file_, "/", "title", title);
    write_geometry(file_, geometry, layout.find(results::kMotionsPath) >= 0);
    table_ = Hdf5Table(file_, layout);
    if (fields != nullptr) {
      fields_ = Hdf5Table(file_, fields->fields, "fields/time", H5T_IEEE_F32LE);
      extremes_ = Hdf5Extremes(file_, fields->extremes);
    }
    if (earlier != nullptr) take_earlier(*earlier, fields != nullptr);
    file_.flush();  // SWMR starts from a file that is complete so far
    table_.close_for_now();
    fields_.close_for_now();
    file_.start_swmr();
    table_.open_again(file_);
    fields_.open_again(file_);
    if (earlier != nullptr) {
      files::sync_to_disk(file_.path());
      if (undo_ != nullptr) undo_->set_aside();  // it belongs to the file that is replaced now
    }
    file_.rename(path);
    if (earlier != nullptr && undo_ != nullptr) {
      undo_->discard();
      begin_undo(checkpoint);
    }
  } catch (...) {
    file_.abandon();
    table_.close();
    fields_.close();
    extremes_.close();
    throw;
  }
  thread_ = std::thread([this] { watch_age(); });
}

Hdf5Recorder::~Hdf5Recorder() {
  try {
    close();
  } catch (...) {  // close() reports it to its caller
  }
}

void Hdf5Recorder::take_earlier(const EarlierRows& earlier, bool has_fields) {
  earlier.records([this](std::span<const double> times, std::span<const double> values) {
    table_.append(file_, times, values);
  });
  if (!has_fields) return;
  earlier.fields([this](std::span<const double> times, std::span<const double> values) {
    fields_.append(file_, times, values);
  });
}

void Hdf5Recorder::write(const results::Record& record) {
  const std::lock_guard lock(mutex_);
  rethrow_failure();
  if (is_large(record)) {
    flush_waiting();
    guarded([&] { table_.append(file_, {&record.t, 1}, record.values); });
    return rethrow_failure();
  }
  note_age();
  times_.push_back(record.t);
  values_.insert(values_.end(), record.values.begin(), record.values.end());
  if (times_.size() >= rule_.records || values_.size() * sizeof(double) >= rule_.bytes) {
    flush_waiting();
    rethrow_failure();
  }
}

void Hdf5Recorder::write_fields(const results::Record& fields) {
  const std::lock_guard lock(mutex_);
  rethrow_failure();
  if (is_large(fields)) {
    flush_waiting();  // the record of this instant, too
    guarded([&] { fields_.append(file_, {&fields.t, 1}, fields.values); });
    return rethrow_failure();
  }
  note_age();
  field_times_.push_back(fields.t);
  field_values_.insert(field_values_.end(), fields.values.begin(), fields.values.end());
  if (field_values_.size() * sizeof(double) >= rule_.bytes) {
    flush_waiting();
    rethrow_failure();
  }
}

void Hdf5Recorder::write_extremes(const std::vector<double>& values) {
  const std::lock_guard lock(mutex_);
  rethrow_failure();
  guarded([&] { extremes_.write(file_, values); });
  rethrow_failure();
}

void Hdf5Recorder::begin_undo(const std::string& checkpoint) {
  const std::lock_guard lock(mutex_);
  if (undo_ != nullptr) undo_->begin(checkpoint, std::filesystem::file_size(file_.path()));
}

void Hdf5Recorder::flush() {
  const std::lock_guard lock(mutex_);
  rethrow_failure();
  flush_waiting();
  rethrow_failure();
}

bool Hdf5Recorder::is_large(const results::Record& record) const {
  return record.values.size() * sizeof(double) > rule_.bytes_at_once;
}

void Hdf5Recorder::note_age() {
  if (!times_.empty() || !field_times_.empty()) return;
  oldest_ = std::chrono::steady_clock::now();
  changed_.notify_one();
}

void Hdf5Recorder::flush_waiting() {
  if (times_.empty() && field_times_.empty()) return;
  // Every instant of fields is one of the records, at any moment and after a crash.
  guarded([&] {
    table_.append(file_, times_, values_);
    fields_.append(file_, field_times_, field_values_);
  });
  times_.clear();
  values_.clear();
  field_times_.clear();
  field_values_.clear();
}

void Hdf5Recorder::guarded(const std::function<void()>& work) {
  if (failure_) return;
  try {
    work();
  } catch (const IoError& error) {
    const std::string before =
        times_.empty() ? "" : fmt::format(" (before t = {} s)", times_.front());
    failure_ = std::make_exception_ptr(
        IoError(fmt::format("{} Recording ends after {} records{}, which stay readable.",
                            error.what(), table_.num_records(), before)));
    file_.abandon();
  } catch (...) {
    failure_ = std::current_exception();
    file_.abandon();
  }
}

void Hdf5Recorder::watch_age() {
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    if (times_.empty() && field_times_.empty()) {
      changed_.wait(lock);
    } else if (std::chrono::steady_clock::now() >= oldest_ + rule_.age) {
      flush_waiting();
    } else {
      changed_.wait_until(lock, oldest_ + rule_.age);
    }
  }
}

void Hdf5Recorder::stop_thread() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void Hdf5Recorder::close() {
  stop_thread();
  flush_waiting();
  table_.close();
  fields_.close();
  extremes_.close();
  try {
    file_.close();
  } catch (const IoError&) {
    if (!failure_) failure_ = std::current_exception();
  }
  file_ = Hdf5File();
  rethrow_failure();
}

void Hdf5Recorder::rethrow_failure() const {
  if (failure_) std::rethrow_exception(failure_);
}

}  // namespace buckens::run_store
