// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/initial/frame_acceleration.h"

namespace buckens::analysis {

double frame_acceleration(const model::Model& model, const model::Load& load,
                          const dynamics::SystemRow& row,
                          const std::vector<dynamics::BodyMotion>& motions,
                          const model::State& state) {
  const auto first = dynamics::evaluate_marker(model, load.first, motions);
  const auto second = dynamics::evaluate_marker(model, load.second, motions);
  double out = model.coordinates[static_cast<std::size_t>(load.coordinate)].law.bias(
      first.motion, second.motion, dynamics::evaluate_bias(model, load.first, motions),
      dynamics::evaluate_bias(model, load.second, motions));
  for (const dynamics::BodyRow* part : row.parts()) {
    if (part->body == model::kGround) continue;
    const auto b = static_cast<std::size_t>(part->body);
    Eigen::Matrix<double, 6, 1> change;
    change << state.bodies[b].w_dot, state.bodies[b].v_dot;
    const Eigen::VectorXd y = Eigen::VectorXd::Zero(motions[b].y.size());
    out += part->change(change, y);
  }
  return out;
}

}  // namespace buckens::analysis
