// SPDX-License-Identifier: Apache-2.0
#include "cli/run_journal.h"

#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::cli {

namespace {

const char* prefix(base::LogLevel level) {
  switch (level) {
    case base::LogLevel::warning:
      return "warning: ";
    case base::LogLevel::error:
      return "error: ";
    case base::LogLevel::debug:
    case base::LogLevel::info:
      break;
  }
  return "";
}

}  // namespace

RunJournal::RunJournal(ProgressDisplay& display, base::LogLevel lowest)
    : display_(display), lowest_(lowest) {
  base::set_log_sink(
      [this](base::LogLevel level, const std::string& message) { say(level, message); });
}

RunJournal::~RunJournal() { base::set_log_sink({}); }

void RunJournal::open(run_store::RunDirectory& directory) {
  const std::lock_guard lock(mutex_);
  directory_ = &directory;
  for (const std::string& line : kept_) append(line);
  kept_.clear();
}

void RunJournal::close() {
  const std::lock_guard lock(mutex_);
  directory_ = nullptr;
}

void RunJournal::say(base::LogLevel level, const std::string& message) {
  if (level >= lowest_ || level == base::LogLevel::warning) {
    const std::lock_guard lock(mutex_);
    told_.insert(message);
  }
  if (level >= lowest_) display_.message(fmt::format("buckens: {}{}", prefix(level), message));
  record(prefix(level) + message);
}

void RunJournal::warn_once(const std::string& message) {
  {
    const std::lock_guard lock(mutex_);
    if (told_.count(message) > 0) return;
  }
  say(base::LogLevel::warning, message);
}

void RunJournal::record(const std::string& lines) {
  const std::lock_guard lock(mutex_);
  const std::string stamped = fmt::format("[{:9.3f} s] {}", seconds(), lines);
  if (directory_ == nullptr) {
    kept_.push_back(stamped);
  } else {
    append(stamped);
  }
}

void RunJournal::append(const std::string& line) {
  try {
    directory_->log(line);
  } catch (const IoError&) {
    // A disk that does not take the log does not take the records either, and that is reported.
  }
}

double RunJournal::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

}  // namespace buckens::cli
