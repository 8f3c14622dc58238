// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdio>
#include <string>

#include "cli/progress_display.h"

#include "buckens/base/work.h"

namespace buckens::cli {

/// "meshing rod.step: faces, 12 of 40, 0:03".
std::string work_line(const base::Work& work, double seconds);

/// Shows on a stream how far work is that the library reports, from its construction to its end:
/// on terminals as one line that is redrawn, elsewhere as a line every few seconds. What the work
/// will come to is said as soon as it is known, on streams that are no terminal only if it is much.
class WorkDisplay {
 public:
  WorkDisplay(std::FILE* stream, ProgressDisplay::Style style);
  ~WorkDisplay();
  WorkDisplay(const WorkDisplay&) = delete;
  WorkDisplay& operator=(const WorkDisplay&) = delete;

 private:
  using Clock = std::chrono::steady_clock;

  void show(const base::Work& work);
  void wipe();

  std::FILE* stream_;
  ProgressDisplay::Style style_;
  Clock::time_point begin_;
  std::string name_, outlook_;  // of the work that goes on, and what was said of it
  std::string stage_;           // shown last, up to its first comma
  double next_ = 0;             // seconds after the beginning at which it is shown again
};

}  // namespace buckens::cli
