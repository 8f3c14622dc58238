// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/step_traffic.h"

namespace buckens::analysis {

namespace {

std::optional<double> border_share(const model::Model& model) {
  double nodes = 0, border = 0;
  for (const body::Body& body : model.bodies) {
    if (!body.is_flexible() || !body.flexible->fe.K.row_order()) continue;
    const fem::NodeParts& parts = body.flexible->fe.parts;
    nodes += static_cast<double>(parts.part.size());
    border += parts.num_border;
  }
  if (nodes == 0) return {};
  return border / nodes;
}

}  // namespace

void add_traffic(const linalg::Traffic& before, results::RunSummary& summary) {
  if (linalg::Ranks::count() == 1) return;
  const linalg::Traffic traffic = linalg::Ranks::traffic().since(before);
  summary.measures.emplace_back("processes", linalg::Ranks::count());
  summary.measures.emplace_back("messages", static_cast<double>(traffic.messages));
  summary.measures.emplace_back("bytes", traffic.bytes);
  summary.measures.emplace_back("bytes_of_whole_matrices", traffic.bytes_of_whole_matrices);
}

void StepTraffic::begin_step() {
  if (!before_) before_ = linalg::Ranks::traffic();
  ++steps_;
}

void StepTraffic::fill(const model::Model& model, results::RunSummary& summary) const {
  if (linalg::Ranks::count() == 1 || steps_ == 0) return;
  const linalg::Traffic now = linalg::Ranks::traffic();
  const auto steps = static_cast<double>(steps_);
  summary.measures.emplace_back("processes", linalg::Ranks::count());
  summary.measures.emplace_back("messages_per_step",
                                static_cast<double>(now.messages - before_->messages) / steps);
  summary.measures.emplace_back("bytes_per_step", (now.bytes - before_->bytes) / steps);
  summary.measures.emplace_back("bytes_of_whole_matrices", now.bytes_of_whole_matrices);
  const std::optional<double> border = border_share(model);
  if (border) summary.measures.emplace_back("border_share", *border);
}

}  // namespace buckens::analysis
