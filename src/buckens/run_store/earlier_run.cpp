// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/earlier_run.h"

#include <array>
#include <system_error>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/run_store/run_files.h"

namespace buckens::run_store {

namespace fs = std::filesystem;

namespace {

constexpr char kAside[] = ".earlier";

/// Files that change their place; log.txt stays, because the lock of the directory is on it, and
/// summary.json, because it marks the directory as that of a run. Both are copied.
constexpr std::array kMoved = {kResultsName, kSensorsName,    kModesName,
                               kModelName,   kCheckpointName, kUndoName};

[[noreturn]] void fail(const fs::path& file, const char* verb, const std::error_code& error) {
  throw IoError(fmt::format("{}: cannot {} the file of an earlier run: {}.", file.string(), verb,
                            error.message()));
}

void move_if_there(const fs::path& from, const fs::path& to) {
  std::error_code error;
  if (!fs::exists(from, error)) return;
  fs::rename(from, to, error);
  if (error) fail(from, "move", error);
}

void remove_if_there(const fs::path& file) {
  std::error_code error;
  fs::remove(file, error);
  if (error) fail(file, "remove", error);
}

}  // namespace

EarlierRun::EarlierRun(const fs::path& run, files::OutputFile& log)
    : run_(run), aside_(run / kAside) {
  std::error_code ignored;
  // The copy of the summary is made before and removed after all else: with it the rest is
  // complete.
  if (fs::exists(aside_ / kSummaryName, ignored)) bring_back(log);
  discard();
  if (!fs::exists(run_ / kResultsName, ignored)) return;
  try {
    put_aside();
  } catch (const IoError&) {
    if (is_aside_) bring_back(log);
    discard();
    throw;
  }
}

void EarlierRun::put_aside() {
  std::error_code error;
  fs::create_directory(aside_, error);
  if (error) fail(aside_, "make room for", error);
  files::replace_text_file(aside_ / kLogName, files::read_text_file(run_ / kLogName));
  files::replace_text_file(aside_ / kSummaryName, files::read_text_file(run_ / kSummaryName));
  is_aside_ = true;
  for (const char* name : kMoved) move_if_there(run_ / name, aside_ / name);
}

void EarlierRun::bring_back(files::OutputFile& log) {
  for (const char* name : kMoved) move_if_there(aside_ / name, run_ / name);
  log.clear();
  log.write(files::read_text_file(aside_ / kLogName));
  const fs::path summary = aside_ / kSummaryName;
  std::error_code error;
  fs::rename(summary, run_ / kSummaryName, error);
  if (error) fail(summary, "move", error);
  discard();
}

void EarlierRun::discard() {
  is_aside_ = false;
  remove_if_there(aside_ / kSummaryName);
  std::error_code error;
  fs::remove_all(aside_, error);
  if (error) fail(aside_, "remove", error);
}

}  // namespace buckens::run_store
