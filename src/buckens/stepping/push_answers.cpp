// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/push_answers.h"

#include <utility>

#include "buckens/dynamics/constraints.h"
#include "buckens/stepping/rigid_rows.h"

namespace buckens::stepping {

using linalg::Vector;

bool PushAnswers::condense(const std::vector<dynamics::BodyCompliance>& compliance,
                           const std::vector<dynamics::BodyMotion>& motions,
                           const std::vector<int>& rows_in_use, const model::RowMemory* memory,
                           double t, const std::vector<dynamics::SystemRow>& closed) {
  compliance_ = &compliance;
  joints_.reset();
  if (rows_in_use.empty() && closed.empty()) return true;
  dynamics::Constraints all;
  dynamics::evaluate_constraints(model_, motions, t, memory, all);
  std::vector<dynamics::SystemRow> rows;
  rows.reserve(rows_in_use.size());
  for (const int row : rows_in_use) rows.push_back(all.rows[static_cast<std::size_t>(row)]);
  std::vector<double> give;
  for (const dynamics::SystemRow& row : closed) {
    rows.push_back(row);
    give.push_back(kRigidGive * own_compliance(row, compliance));
  }
  joints_.emplace(static_cast<int>(motions.size()), rows);
  return factorise_closed_rows(*joints_, rows, compliance, give);
}

void PushAnswers::answer(Push& push) const {
  const std::vector<dynamics::BodyCompliance>& compliance = *compliance_;
  const std::size_t count = model_.bodies.size();
  std::vector<dynamics::BodyResponse> loads(count);
  push.u.assign(count, Vector6::Zero());
  push.y.resize(count);
  for (std::size_t b = 0; b < count; ++b) {
    loads[b].interface_load.setZero(model_.bodies[b].num_interface_rows());
    push.y[b].setZero(model_.bodies[b].num_interface_rows());
  }
  for (const dynamics::BodyRow* part : {&push.row.first, &push.row.second}) {
    if (part->body == model::kGround) continue;
    dynamics::BodyResponse& load = loads[static_cast<std::size_t>(part->body)];
    load.frame_load += part->frame.transpose();
    for (int i = 0; i < 6; ++i) {
      const int first = i < 3 ? part->translation_row : part->rotation_row;
      if (first >= 0) load.interface_load[first + i % 3] += part->interface[i];
    }
  }
  const auto move = [&](std::size_t b) {
    push.u[b] = compliance[b].frame * loads[b].frame_load;
    if (compliance[b].interface != nullptr) {
      push.y[b] = *compliance[b].interface * loads[b].interface_load;
    }
  };
  for (std::size_t b = 0; b < count; ++b) move(b);
  if (joints_) {
    Vector X;
    joints_->test_rows().changes(X, [&](int b) {
      const auto k = static_cast<std::size_t>(b);
      return dynamics::Displacement{&push.u[k], &push.y[k]};
    });
    X = -X;
    joints_->solve_in_place(X);
    std::vector<dynamics::BodyResponse> of_joints(count);
    for (std::size_t b = 0; b < count; ++b) {
      of_joints[b].interface_load.setZero(loads[b].interface_load.size());
    }
    joints_->gather(X, of_joints);
    for (std::size_t b = 0; b < count; ++b) {
      loads[b].frame_load += of_joints[b].frame_load;
      loads[b].interface_load += of_joints[b].interface_load;
      move(b);
    }
  }
  push.load.clear();
  for (dynamics::BodyResponse& load : loads) push.load.push_back(std::move(load.interface_load));
}

double PushAnswers::along(const dynamics::SystemRow& row, const Push& push) {
  double sum = 0;
  for (const dynamics::BodyRow* part : {&row.first, &row.second}) {
    if (part->body == model::kGround) continue;
    const auto b = static_cast<std::size_t>(part->body);
    sum += part->change(push.u[b], push.y[b]);
  }
  return sum;
}

}  // namespace buckens::stepping
