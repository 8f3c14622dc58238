// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "buckens/linalg/ranks.h"
#include "buckens/model/model.h"
#include "buckens/results/run_summary.h"

namespace buckens::analysis {

/// Adds "processes", "messages", "bytes" and "bytes_of_whole_matrices" since `before` to the
/// measures, if there are several processes.
void add_traffic(const linalg::Traffic& before, results::RunSummary& summary);

/// Counts what the steps of a run exchange between processes (linalg::Traffic).
class StepTraffic {
 public:
  /// Before each step.
  void begin_step();
  /// Adds "processes", "messages_per_step" and "bytes_per_step" to the measures, and
  /// "bytes_of_whole_matrices" from the start of the program, if there are several processes and
  /// were steps; and "border_share": of the nodes of bodies that are divided among processes, the
  /// share with an element that has nodes of several.
  void fill(const model::Model& model, results::RunSummary& summary) const;

 private:
  std::optional<linalg::Traffic> before_;  // the first step
  long steps_ = 0;
};

}  // namespace buckens::analysis
