// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/constraints.h"

namespace buckens::dynamics {

void evaluate_constraints(const model::Model& model, const std::vector<BodyMotion>& motions,
                          double t, Constraints& out) {
  const int count = model.num_constraint_rows();
  out.g.resize(count);
  out.g_dot.resize(count);
  out.g_t.resize(count);
  out.rows.resize(static_cast<std::size_t>(count));
  for (const model::Joint& joint : model.joints) {
    const auto first = evaluate_marker(model, joint.first, motions);
    const auto second = evaluate_marker(model, joint.second, motions);
    Eigen::Matrix<double, 12, 1> V;
    V << first.motion.w, first.motion.v, second.motion.w, second.motion.v;
    int row = joint.first_row;
    for (const joints::ConstraintRow& constraint : joint.rows) {
      const joints::RowValue value = constraint.evaluate(first.motion, second.motion, t);
      out.g[row] = value.g;
      out.g_dot[row] = value.J.dot(V) + value.g_t;
      out.g_t[row] = value.g_t;
      out.rows[static_cast<std::size_t>(row)] =
          system_row(model, joint.first, first, joint.second, second, value.J);
      ++row;
    }
  }
}

linalg::Vector constraint_bias(const model::Model& model, const std::vector<BodyMotion>& motions,
                               double t) {
  linalg::Vector bias(model.num_constraint_rows());
  for (const model::Joint& joint : model.joints) {
    const auto first = evaluate_marker(model, joint.first, motions);
    const auto second = evaluate_marker(model, joint.second, motions);
    const auto bias_first = evaluate_bias(model, joint.first, motions);
    const auto bias_second = evaluate_bias(model, joint.second, motions);
    for (std::size_t k = 0; k < joint.rows.size(); ++k) {
      bias[joint.first_row + static_cast<int>(k)] =
          joint.rows[k].bias(first.motion, second.motion, bias_first, bias_second, t);
    }
  }
  return bias;
}

}  // namespace buckens::dynamics
