// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/step_traffic.h"

namespace buckens::analysis {

void StepTraffic::begin_step() {
  if (!before_) before_ = linalg::Ranks::traffic();
  ++steps_;
}

void StepTraffic::fill(results::RunSummary& summary) const {
  if (linalg::Ranks::count() == 1 || steps_ == 0) return;
  const linalg::Traffic now = linalg::Ranks::traffic();
  const auto steps = static_cast<double>(steps_);
  summary.measures.emplace_back("processes", linalg::Ranks::count());
  summary.measures.emplace_back("messages_per_step",
                                static_cast<double>(now.messages - before_->messages) / steps);
  summary.measures.emplace_back("bytes_per_step", (now.bytes - before_->bytes) / steps);
}

}  // namespace buckens::analysis
