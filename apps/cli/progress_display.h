// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <mutex>
#include <string>

#include "buckens/analysis/simulation/simulate.h"

namespace buckens::cli {

/// Columns of a terminal; 80 if it does not say.
int columns_of(std::FILE* stream);

/// "0:07", "12:30", "3:05:00"; "?" if unknown.
std::string clock_text(double seconds);

/// One line: time, step, steps per second, time to go.
/// @param seconds wall time since the first step began
std::string progress_line(const analysis::Progress& progress, double seconds);

/// The same with a bar, at most `columns` wide.
std::string progress_bar(const analysis::Progress& progress, double seconds, int columns);

/// Shows the progress of a simulation on a stream, without disturbing messages on the same stream.
class ProgressDisplay {
 public:
  enum class Style {
    none,
    bar,    ///< one line that is redrawn, at most ten times a second; for terminals
    lines,  ///< a new line every few seconds; for files and pipes
  };

  ProgressDisplay(std::FILE* stream, Style style) : stream_(stream), style_(style) {}
  ~ProgressDisplay() { clear(); }
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// @param seconds wall time since the first step began
  void show(const analysis::Progress& progress, double seconds);
  /// Prints a line, above the bar if there is one. May be called from any thread.
  void message(const std::string& line);
  /// Removes the bar.
  void clear();

 private:
  void wipe();

  std::FILE* stream_;
  Style style_;
  std::mutex mutex_;
  bool bar_stands_ = false;
  double next_ = 0;  // wall time of the next update [s]
};

/// The style for a stream: a bar on terminals that can redraw a line, lines elsewhere.
ProgressDisplay::Style style_for(std::FILE* stream);

}  // namespace buckens::cli
