// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "cli/progress_display.h"

#include "buckens/base/log.h"
#include "buckens/run_store/run_directory.h"

namespace buckens::cli {

/// Messages of a run: all of them to log.txt, those the user wants to see to the terminal.
///
/// Receives the messages of the library while it lives. Lines before there is a run directory are
/// kept for it.
class RunJournal {
 public:
  /// @param lowest messages below this level go to the log only
  RunJournal(ProgressDisplay& display, base::LogLevel lowest);
  ~RunJournal();
  RunJournal(const RunJournal&) = delete;
  RunJournal& operator=(const RunJournal&) = delete;

  /// Sends lines to log.txt of this directory, starting with those so far.
  void open(run_store::RunDirectory& directory);
  /// The directory's log ends; later lines go to the terminal only.
  void close();

  void say(base::LogLevel level, const std::string& message);
  /// Prints a warning unless it has been shown or, as a warning, recorded before.
  void warn_once(const std::string& message);
  /// Lines for the log only.
  void record(const std::string& lines);

  /// Wall time since the journal was created [s].
  double seconds() const;

 private:
  void append(const std::string& line);

  ProgressDisplay& display_;
  base::LogLevel lowest_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  std::vector<std::string> kept_;
  std::set<std::string> told_;  // warnings, and what was shown
  run_store::RunDirectory* directory_ = nullptr;
};

}  // namespace buckens::cli
