// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/initial/impulses.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/dynamics/mass_metric.h"
#include "buckens/stepping/rigid_rows.h"

namespace buckens::analysis {

namespace {

bool acts_alike(const dynamics::SystemRow& one, const dynamics::SystemRow& other) {
  if (one.num_parts() != other.num_parts() || one.travelling != other.travelling) return false;
  for (std::size_t k = 0; k < one.num_parts(); ++k) {
    const dynamics::BodyRow &a = one.part(k), &b = other.part(k);
    if (a.body != b.body || a.translation_row != b.translation_row ||
        a.rotation_row != b.rotation_row) {
      return false;
    }
  }
  return true;
}

}  // namespace

Impulses::Impulses(const model::Model& model, const stepping::Stepper* meshes)
    : model_(model),
      interface_(model.bodies.size()),
      responses_(model.bodies.size()),
      frame_moved_(model.bodies.size()),
      interface_moved_(model.bodies.size()) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (meshes != nullptr) interface_[b] = meshes->impulse_compliance(b);
    compliance_.push_back({dynamics::frame_mobility(model.bodies[b], model.bodies[b].J0),
                           interface_[b].size() > 0 ? &interface_[b] : nullptr});
  }
}

void Impulses::place(const model::State& state, const std::vector<int>& rows_in_use) {
  t_ = state.t;
  for (std::vector<double>* values : {&gaps_, &rates_, &give_}) values->clear();
  rows_.clear();
  dynamics::motions_of(model_, state, motions_);
  dynamics::evaluate_constraints(model_, motions_, state.t, &state.memory, joints_);
  for (const int row : rows_in_use) {
    rows_.push_back(joints_.rows[static_cast<std::size_t>(row)]);
    gaps_.push_back(joints_.g[row]);
    rates_.push_back(joints_.g_dot[row]);
  }
  if (model_.num_rigid_rows() == 0) return;
  dynamics::evaluate_soft_rows(model_, motions_, state.t, dynamics::circumstances_of(state), soft_);
  for (std::size_t k = 0; k < soft_.rows.size(); ++k) {
    if (soft_.is_closed[k]) add_rigid_row(soft_.rows[k]);
  }
}

void Impulses::add_rigid_row(const dynamics::SystemRow& row) {
  give_.push_back(stepping::kRigidGive * stepping::own_compliance(row, compliance_));
  double rate = 0;
  for (const dynamics::BodyRow* part : row.parts()) {
    if (part->body != model::kGround) {
      rate += part->rate(motions_[static_cast<std::size_t>(part->body)]);
    }
  }
  rows_.push_back(row);
  gaps_.push_back(0.0);
  rates_.push_back(rate);
}

void Impulses::follow_pattern() {
  if (condensation_ &&
      std::equal(rows_.begin(), rows_.end(), pattern_.begin(), pattern_.end(), acts_alike)) {
    return;
  }
  pattern_ = rows_;
  condensation_ = std::make_unique<dynamics::MultiplierCondensation>(
      static_cast<int>(model_.bodies.size()), rows_);
}

void Impulses::find(const std::vector<double>& values) {
  for (std::size_t b = 0; b < responses_.size(); ++b) {
    responses_[b].frame_load.setZero();
    responses_[b].interface_load.setZero(model_.bodies[b].num_interface_rows());
  }
  if (rows_.empty()) return;
  follow_pattern();
  if (!stepping::factorise_closed_rows(*condensation_, rows_, compliance_, give_)) {
    throw NumericalError(fmt::format(
        "the joint equations have become dependent after an impact or a jump of forces at "
        "t = {:.6g} s (a singular position); check whether the mechanism is at a dead centre there",
        t_));
  }
  X_ = -Eigen::Map<const linalg::Vector>(values.data(), std::ssize(values));
  condensation_->solve_in_place(X_);
  condensation_->gather(X_, responses_);
}

void Impulses::find_moved(const std::vector<dynamics::BodyResponse>& impulses) {
  for (std::size_t b = 0; b < impulses.size(); ++b) {
    frame_moved_[b] = compliance_[b].frame * impulses[b].frame_load;
    interface_moved_[b].setZero(impulses[b].interface_load.size());
    if (interface_[b].size() > 0) {
      interface_moved_[b].noalias() = interface_[b] * impulses[b].interface_load;
    }
  }
  moved_.clear();
  for (const dynamics::SystemRow& row : rows_) {
    double moved = 0;
    for (std::size_t k = 0; k < row.num_parts(); ++k) {
      const dynamics::BodyRow& part = row.part(k);
      if (part.body == model::kGround) continue;
      const auto b = static_cast<std::size_t>(part.body);
      moved += part.change(frame_moved_[b], interface_moved_[b]);
    }
    moved_.push_back(moved);
  }
}

}  // namespace buckens::analysis
