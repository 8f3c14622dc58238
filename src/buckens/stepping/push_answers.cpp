// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/push_answers.h"

#include <algorithm>
#include <utility>

#include "buckens/dynamics/constraints.h"
#include "buckens/stepping/rigid_rows.h"

namespace buckens::stepping {

using linalg::Vector;

bool PushAnswers::condense(const std::vector<dynamics::BodyCompliance>& compliance,
                           const std::vector<dynamics::BodyMotion>& motions,
                           const std::vector<int>& rows_in_use, const model::RowMemory* memory,
                           double t, const std::vector<dynamics::SystemRow>& closed,
                           const std::vector<double>& give) {
  compliance_ = &compliance;
  joints_.reset();
  if (rows_in_use.empty() && closed.empty()) return true;
  dynamics::Constraints all;
  dynamics::evaluate_constraints(model_, motions, t, memory, all);
  std::vector<dynamics::SystemRow> rows;
  rows.reserve(rows_in_use.size());
  for (const int row : rows_in_use) rows.push_back(all.rows[static_cast<std::size_t>(row)]);
  rows.insert(rows.end(), closed.begin(), closed.end());
  joints_.emplace(static_cast<int>(motions.size()), rows);
  if (!give.empty()) return joints_->factorise(rows, rows, compliance, give);
  std::vector<double> least;
  for (const dynamics::SystemRow& row : closed) {
    least.push_back(kRigidGive * own_compliance(row, compliance));
  }
  return factorise_closed_rows(*joints_, rows, compliance, least);
}

namespace {

/// Adds a unit of a row's force to what it acts on.
void add_unit(const dynamics::BodyRow& part, dynamics::BodyResponse& load) {
  load.frame_load += part.frame.transpose();
  for (int i = 0; i < 6; ++i) {
    const int first = i < 3 ? part.translation_row : part.rotation_row;
    if (first >= 0) load.interface_load[first + i % 3] += part.interface[i];
  }
}

}  // namespace

void PushAnswers::answer(Push& push) const {
  push.bodies.clear();
  if (joints_ || !push.row.more.empty()) return answer_all(push);
  for (const dynamics::BodyRow* part : push.row.parts()) {
    if (part->body == model::kGround) continue;
    const auto b = static_cast<std::size_t>(part->body);
    dynamics::BodyResponse load;
    load.interface_load.setZero(model_.bodies[b].num_interface_rows());
    add_unit(*part, load);
    push.bodies.push_back(move(b, std::move(load)));
  }
  if (push.bodies.size() == 2 && push.bodies[1].body < push.bodies[0].body) {
    std::swap(push.bodies[0], push.bodies[1]);
  }
}

PushedBody PushAnswers::move(std::size_t b, dynamics::BodyResponse load) const {
  const dynamics::BodyCompliance& compliance = (*compliance_)[b];
  PushedBody out;
  out.body = b;
  out.u = compliance.frame * load.frame_load;
  if (compliance.interface != nullptr) {
    out.y = *compliance.interface * load.interface_load;
  } else {
    out.y.setZero(load.interface_load.size());
  }
  out.load = std::move(load.interface_load);
  return out;
}

void PushAnswers::answer_all(Push& push) const {
  const std::size_t count = model_.bodies.size();
  std::vector<dynamics::BodyResponse> loads(count), of_joints(count);
  for (std::size_t b = 0; b < count; ++b) {
    loads[b].interface_load.setZero(model_.bodies[b].num_interface_rows());
    of_joints[b].interface_load = loads[b].interface_load;
  }
  for (const dynamics::BodyRow* part : push.row.parts()) {
    if (part->body != model::kGround) add_unit(*part, loads[static_cast<std::size_t>(part->body)]);
  }
  std::vector<PushedBody> moved;
  for (std::size_t b = 0; b < count; ++b) moved.push_back(move(b, loads[b]));
  if (joints_) {
    Vector X;
    joints_->test_rows().changes(X, [&](int b) {
      const PushedBody& own = moved[static_cast<std::size_t>(b)];
      return dynamics::Displacement{&own.u, &own.y};
    });
    X = -X;
    joints_->solve_in_place(X);
    joints_->gather(X, of_joints);
  }
  for (std::size_t b = 0; b < count; ++b) {
    loads[b].frame_load += of_joints[b].frame_load;
    loads[b].interface_load += of_joints[b].interface_load;
    const bool is_reached =
        !loads[b].frame_load.isZero(0.0) || !loads[b].interface_load.isZero(0.0);
    if (is_reached) push.bodies.push_back(move(b, std::move(loads[b])));
  }
}

double PushAnswers::along(const dynamics::SystemRow& row, const Push& push) {
  double sum = 0;
  for (const dynamics::BodyRow* part : row.parts()) {
    if (part->body == model::kGround) continue;
    const auto b = static_cast<std::size_t>(part->body);
    const auto found =
        std::lower_bound(push.bodies.begin(), push.bodies.end(), b,
                         [](const PushedBody& one, std::size_t body) { return one.body < body; });
    if (found != push.bodies.end() && found->body == b) sum += part->change(found->u, found->y);
  }
  return sum;
}

linalg::SparseMatrix PushAnswers::along_all(const std::vector<const Push*>& pushes) {
  const auto n = static_cast<Eigen::Index>(pushes.size());
  std::size_t count = 0;
  for (const Push* push : pushes) {
    if (!push->bodies.empty()) count = std::max(count, push->bodies.back().body + 1);
  }
  std::vector<std::vector<Eigen::Index>> rows_of(count);  // per body
  for (Eigen::Index i = 0; i < n; ++i) {
    const dynamics::SystemRow& row = pushes[static_cast<std::size_t>(i)]->row;
    for (const dynamics::BodyRow* part : row.parts()) {
      const auto b = static_cast<std::size_t>(part->body);
      if (part->body != model::kGround && b < count) rows_of[b].push_back(i);
    }
  }
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<Eigen::Index> seen(pushes.size(), -1);  // the last column that a row is in
  for (Eigen::Index j = 0; j < n; ++j) {
    const Push& push = *pushes[static_cast<std::size_t>(j)];
    for (const PushedBody& moved : push.bodies) {
      for (const Eigen::Index i : rows_of[moved.body]) {
        if (std::exchange(seen[static_cast<std::size_t>(i)], j) == j) continue;
        entries.emplace_back(static_cast<int>(i), static_cast<int>(j),
                             along(pushes[static_cast<std::size_t>(i)]->row, push));
      }
    }
  }
  linalg::SparseMatrix D(n, n);
  D.setFromTriplets(entries.begin(), entries.end());
  return D;
}

}  // namespace buckens::stepping
