// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "buckens/linalg/ranks.h"
#include "buckens/results/run_summary.h"

namespace buckens::analysis {

/// Counts what the steps of a run exchange between processes (linalg::Traffic).
class StepTraffic {
 public:
  /// Before each step.
  void begin_step();
  /// Adds "processes", "messages_per_step" and "bytes_per_step" to the measures, if there are
  /// several processes and were steps.
  void fill(results::RunSummary& summary) const;

 private:
  std::optional<linalg::Traffic> before_;  // the first step
  long steps_ = 0;
};

}  // namespace buckens::analysis
