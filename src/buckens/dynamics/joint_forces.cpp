// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/joint_forces.h"

namespace buckens::dynamics {

namespace {

using Wrenches = Eigen::Matrix<double, 12, 1>;  // torque and force on either marker

void add_to_body(const model::Model& model, const model::MarkerId& id,
                 const body::MarkerKinematics& kinematics, const Eigen::Matrix<double, 6, 1>& load,
                 Forces& out) {
  if (id.body == model::kGround) return;
  add_wrench(model, id, kinematics, {load.head<3>(), load.tail<3>()}, out);
}

}  // namespace

void evaluate_joints(const model::Model& model, const std::vector<BodyMotion>& motions, double t,
                     Constraints& out, const linalg::Vector* lambda, Forces* forces) {
  const int count = model.num_constraint_rows();
  out.g.resize(count);
  out.g_dot.resize(count);
  out.g_t.resize(count);
  for (const model::Joint& joint : model.joints) {
    const auto first = evaluate_marker(model, joint.first, motions);
    const auto second = evaluate_marker(model, joint.second, motions);
    Wrenches twists;
    twists << first.motion.w, first.motion.v, second.motion.w, second.motion.v;
    Wrenches load = Wrenches::Zero();
    int row = joint.first_row;
    for (const joints::ConstraintRow& constraint : joint.rows) {
      const joints::RowValue value = constraint.evaluate(first.motion, second.motion, t);
      out.g[row] = value.g;
      out.g_dot[row] = value.J.dot(twists) + value.g_t;
      out.g_t[row] = value.g_t;
      if (lambda != nullptr) load += (*lambda)[row] * value.J.transpose();
      ++row;
    }
    if (forces == nullptr) continue;
    add_to_body(model, joint.first, first, load.head<6>(), *forces);
    add_to_body(model, joint.second, second, load.tail<6>(), *forces);
  }
}

}  // namespace buckens::dynamics
