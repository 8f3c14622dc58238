// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "buckens/base/stopwatch.h"

namespace buckens::base {

/// Wall time of parts of a longer piece of work, by name and in the order in which they began [s].
using PhaseSeconds = std::vector<std::pair<std::string, double>>;

/// Measures, while it lives, a part of what the calling thread does, for reports. Time within an
/// inner phase counts for that one only; phases of one name are added.
class TimedPhase {
 public:
  /// @param name lives longer
  explicit TimedPhase(const char* name);
  ~TimedPhase();
  TimedPhase(const TimedPhase&) = delete;
  TimedPhase& operator=(const TimedPhase&) = delete;

 private:
  TimedPhase* outer_;
  const char* name_;
  Stopwatch watch_;
  double inner_ = 0;  // time within phases in this one
};

/// What the phases of this thread have taken since the last call.
PhaseSeconds take_phases();

/// Adds those of another list, name by name.
void add_phases(const PhaseSeconds& more, PhaseSeconds& to);

}  // namespace buckens::base
