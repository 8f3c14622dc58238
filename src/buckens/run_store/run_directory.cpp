// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/run_directory.h"

#include <exception>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/log.h"
#include "buckens/base/version.h"
#include "buckens/run_store/state_file.h"
#include "buckens/run_store/summary_json.h"

namespace buckens::run_store {

namespace {

namespace fs = std::filesystem;

/// True if there is nothing but what a run leaves that ended in its very first moments, for
/// instance because the disk was full.
bool holds_first_traces(const fs::path& directory) {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory, ignored)) {
    const std::string name = entry.path().filename().string();
    const bool trace = name == std::string(kSummaryName) + ".part" ||
                       (name == kLogName && entry.file_size(ignored) == 0);
    if (!trace) return false;
  }
  return true;
}

/// True for a directory that an earlier run of ours has made.
bool holds_run(const fs::path& directory) {
  const fs::path summary = directory / kSummaryName;
  std::error_code ignored;
  if (!fs::is_regular_file(summary, ignored)) return holds_first_traces(directory);
  return is_summary_json(files::read_text_file(summary));
}

void create_or_accept(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::exists(status) && !fs::is_directory(status)) {
    throw IoError(fmt::format(
        "{}: is a file; expected a directory for the results. Choose another name (-o).",
        path.string()));
  }
  fs::create_directories(path, error);
  if (error) {
    throw IoError(
        fmt::format("{}: cannot create the directory for the results: {}. Choose a "
                    "place where you may write (-o).",
                    path.string(), error.message()));
  }
  static_cast<void>(fs::is_empty(path, error));
  if (error) {
    throw IoError(fmt::format("{}: cannot read the directory for the results: {}.", path.string(),
                              error.message()));
  }
  if (!holds_run(path)) {
    throw IoError(
        fmt::format("{}: the directory is not empty and holds no earlier run, so nothing "
                    "is overwritten. Choose another one (-o), or empty it.",
                    path.string()));
  }
}

}  // namespace

RunDirectory::RunDirectory(fs::path path, RunDirectoryOptions options)
    : path_(std::move(path)), options_(std::move(options)), started_(files::utc_now()) {
  options_.continues ? take_up() : take_directory();
}

/// @pre the directory holds a run
void RunDirectory::take_up() {
  log_ = files::OutputFile(path_ / kLogName, files::OutputFile::Start::as_it_is);
  lock();
  kept_ = std::make_unique<KeptRecords>(path_, *options_.continues);
}

void RunDirectory::lock() {
  if (log_.try_lock()) return;
  throw IoError(
      fmt::format("{}: another run is writing into this directory. Wait for its end, "
                  "or choose another directory (-o).",
                  path_.string()));
}

void RunDirectory::take_directory() {
  create_or_accept(path_);
  // Opening the log shows, before anything is removed, that files can be created here.
  log_ = files::OutputFile(path_ / kLogName, files::OutputFile::Start::as_it_is);
  lock();
  earlier_ = EarlierRun(path_, log_);
  try {
    write_first_files();
  } catch (const IoError&) {
    if (earlier_.is_aside()) earlier_.bring_back(log_);
    throw;
  }
  if (earlier_.is_aside() && !options_.keeps_earlier_run) earlier_.discard();
}

void RunDirectory::write_first_files() {
  // The new summary comes first: it needs room on the disk, and from here on the directory counts
  // as that of a run whatever happens.
  write_status(status_json(RunStatus::starting, options_.title, kVersion, started_));
  log_.clear();
  for (const fs::path& name :
       {fs::path(kResultsName), fs::path(std::string(kResultsName) + ".part"),
        fs::path(kSensorsName), fs::path(kModesName), fs::path(kCheckpointName)}) {
    std::error_code error;
    fs::remove(path_ / name, error);
    if (error) {
      throw IoError(fmt::format("{}: cannot remove the file of an earlier run: {}.",
                                (path_ / name).string(), error.message()));
    }
  }
  undo_.discard();
  files::replace_text_file(path_ / kModelName, options_.model_text);
}

RunDirectory::~RunDirectory() {
  if (finished_) return;
  try {
    results::RunSummary summary;
    summary.title = options_.title;
    summary.interrupted = "the run ended without a summary";
    summary.end_time = last_time_;
    finish(summary);
  } catch (...) {  // nothing more can be done; what was flushed stays readable
  }
}

void RunDirectory::write_status(std::string_view json) const {
  files::replace_text_file(path_ / kSummaryName, json);
}

void RunDirectory::begin(const results::RecordLayout& layout, const results::Geometry& geometry) {
  num_values_ = layout.num_values();
  if (kept_) {
    go_on_recording(layout, geometry);
    files::replace_text_file(path_ / kModelName, options_.model_text);
    kept_.reset();
  } else {
    recorder_ = std::make_unique<Hdf5Recorder>(path_ / kResultsName, writer_, layout, geometry,
                                               fields_ ? &*fields_ : nullptr, options_.title,
                                               kVersion, options_.flush, &undo_);
    sensors_ = SensorsCsv(path_ / kSensorsName, layout);
  }
  write_status(status_json(RunStatus::running, options_.title, kVersion, started_));
  if (earlier_.is_aside()) earlier_.discard();
}

/// Both files are written anew with the records that are kept. Ended at any moment, this leaves
/// results that hold all of them.
void RunDirectory::go_on_recording(const results::RecordLayout& layout,
                                   const results::Geometry& geometry) {
  undo_.take_back();
  const fs::path part = path_ / (std::string(kSensorsName) + ".part");
  SensorsCsv sensors(part, layout);
  EarlierRows earlier;
  earlier.records = [&](const AppendRows& append) {
    kept_->copy_records(layout, [&](std::span<const double> times, std::span<const double> values) {
      append(times, values);
      for (std::size_t row = 0; row < times.size(); ++row) {
        const auto first = values.begin() + static_cast<std::ptrdiff_t>(row * num_values_);
        sensors.write({times[row], {first, first + static_cast<std::ptrdiff_t>(num_values_)}});
      }
    });
  };
  earlier.fields = [&](const AppendRows& append) { kept_->copy_fields(fields_->fields, append); };
  recorder_ = std::make_unique<Hdf5Recorder>(path_ / kResultsName, writer_, layout, geometry,
                                             fields_ ? &*fields_ : nullptr, options_.title,
                                             kVersion, options_.flush, &undo_, &earlier,
                                             checkpoint_mark(path_ / kCheckpointName));
  std::error_code error;
  fs::rename(part, path_ / kSensorsName, error);
  if (error) {
    throw IoError(fmt::format("{}: cannot replace the file: {}.", (path_ / kSensorsName).string(),
                              error.message()));
  }
  sensors_ = std::move(sensors);
}

void RunDirectory::begin_fields(const results::FieldLayout& layout) { fields_ = layout; }

/// The error of a failed recorder is reported again.
void RunDirectory::guarded(const std::function<void()>& work) {
  if (!recorder_) throw IoError(fmt::format("{}: no record is expected now.", path_.string()));
  if (!failure_.empty()) throw IoError(failure_);
  try {
    work();
  } catch (const IoError& error) {
    failure_ = error.what();
    throw;
  }
}

void RunDirectory::write(const results::Record& record) {
  if (recorder_ && record.values.size() != num_values_) {
    throw IoError(fmt::format("{}: record at t = {} s: {} values for channels that hold {}.",
                              path_.string(), record.t, record.values.size(), num_values_));
  }
  guarded([&] {
    recorder_->write(record);
    sensors_.write(record);
  });
  last_time_ = record.t;
}

void RunDirectory::write_fields(const results::Record& fields) {
  if (!fields_ || fields.values.size() != fields_->fields.num_values()) {
    throw IoError(fmt::format("{}: fields at t = {} s: {} values for channels that hold {}.",
                              path_.string(), fields.t, fields.values.size(),
                              fields_ ? fields_->fields.num_values() : 0));
  }
  guarded([&] { recorder_->write_fields(fields); });
}

void RunDirectory::write_extremes(const std::vector<double>& values) {
  guarded([&] { recorder_->write_extremes(values); });
}

void RunDirectory::flush() {
  if (recorder_) guarded([&] { recorder_->flush(); });
}

void RunDirectory::write_checkpoint(const base::SavedValues& state) {
  guarded([&] { recorder_->flush(); });
  try_checkpoint(state);
}

void RunDirectory::try_checkpoint(const base::SavedValues& state) {
  try {
    // Model and summary as well: without them nothing goes on.
    for (const char* name : {kModelName, kSummaryName, kResultsName, kSensorsName}) {
      files::sync_to_disk(path_ / name);
    }
    write_state(state, path_ / kCheckpointName);
    if (recorder_) {
      recorder_->begin_undo(checkpoint_mark(path_ / kCheckpointName));
    } else {
      undo_.discard();
    }
  } catch (const IoError& error) {
    base::log(base::LogLevel::warning,
              fmt::format("no checkpoint at t = {:.6g} s: {}", last_time_, error.what()));
  }
}

void RunDirectory::finish(const results::RunSummary& summary) {
  if (finished_) return;
  finished_ = true;
  if (options_.continues && !recorder_) {
    has_earlier_run_back_ = true;
    return log_.close();
  }
  if (earlier_.is_aside()) {
    recorder_.reset();
    sensors_.close();
    earlier_.bring_back(log_);
    has_earlier_run_back_ = true;
    return log_.close();
  }
  results::RunSummary told = summary;
  if (told.version.empty()) told.version = kVersion;
  if (told.title.empty()) told.title = options_.title;
  const bool has_records = recorder_ != nullptr;
  std::exception_ptr failure;
  try {
    if (recorder_) recorder_->close();
    sensors_.close();
  } catch (const IoError& error) {
    if (failure_.empty()) failure = std::current_exception();  // otherwise `write` has reported it
    failure_ = error.what();
  }
  recorder_.reset();
  if (!failure_.empty()) {
    told.finished = false;
    if (told.interrupted.empty()) told.interrupted = failure_;
  }
  write_status(summary_json(told, started_, files::utc_now()));
  // Last, so that a run which is killed before has one to complete its files from.
  if (failure_.empty() && has_records && last_state_) try_checkpoint(last_state_());
  log_.close();
  if (failure) std::rethrow_exception(failure);
}

void RunDirectory::log(std::string_view lines) {
  log_.write(lines);
  if (lines.empty() || lines.back() != '\n') log_.write("\n");
}

}  // namespace buckens::run_store
