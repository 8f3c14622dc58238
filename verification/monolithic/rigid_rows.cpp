// SPDX-License-Identifier: Apache-2.0
// Rigid rows of force laws, and laws that are held, in the slow route of a step.
#include "verification/monolithic/stepper.h"

namespace buckens::verification {

using linalg::Triplet;
using linalg::Vector;

void MonolithicStepper::fixed_rigid_corrections() {
  for (std::size_t k = 0; k < correcting_.rows.size(); ++k) {
    if (correcting_.rigid[k] < 0) continue;
    const int column = first_rigid_correction_ + correcting_.rigid[k];
    const loads::RigidRow& now = forces_.rigid[static_cast<std::size_t>(correcting_.rigid[k])];
    if (!correcting_.is_closed[k]) {
      fixed_.emplace_back(column, column, 1.0);
      continue;
    }
    for (const Entry& e : entries(correcting_.rows[k])) {
      fixed_.emplace_back(e.correction_column, column, -e.value);
      // A row that holds rates only lets no correction move along it.
      if (!now.holds_position) fixed_.emplace_back(column, e.correction_column, e.value);
    }
  }
}

void MonolithicStepper::rigid_tangent(std::vector<Triplet>& out) const {
  for (std::size_t k = 0; k < soft_.rows.size(); ++k) {
    if (soft_.rigid[k] < 0) continue;
    const int velocity = first_rigid_ + soft_.rigid[k];
    const int position = first_rigid_correction_ + soft_.rigid[k];
    if (!soft_.is_closed[k]) {
      out.emplace_back(velocity, velocity, 1.0);
      continue;
    }
    const loads::RigidRow& now = forces_.rigid[static_cast<std::size_t>(soft_.rigid[k])];
    for (const Entry& e : entries(soft_.rows[k])) {
      out.emplace_back(e.column, velocity, -e.value);
      out.emplace_back(velocity, e.column, e.value);
      if (!now.holds_position) continue;
      out.emplace_back(position, e.column, e.value);
      out.emplace_back(position, e.correction_column, e.value);
    }
  }
}

void MonolithicStepper::rigid_residual(Vector& r) const {
  for (std::size_t k = 0; k < forces_.rigid.size(); ++k) {
    const loads::RigidRow& row = forces_.rigid[k];
    if (!row.is_closed) continue;
    r[first_rigid_ + static_cast<int>(k)] = row.slip / scheme_.end_rate;
    if (row.holds_position) r[first_rigid_correction_ + static_cast<int>(k)] = row.gap;
  }
}

void MonolithicStepper::hold_reversed(double t) {
  const double t_e = scheme_.evaluation_time(t);
  if (regimes_before_.size() == soft_.regimes.size()) {
    held_.hold_reversed(regimes_before_, motions_evaluation_, t_e, around(), soft_);
  } else {
    held_.begin(motions_evaluation_, t_e, around());
  }
  regimes_before_ = soft_.regimes;
}

void MonolithicStepper::held_residual(double t, Vector& r) const {
  held_.for_excess(motions_evaluation_, scheme_.evaluation_time(t), around(),
                   [&](int soft, double excess) {
                     for (const Entry& e : entries(soft_.rows[static_cast<std::size_t>(soft)])) {
                       r[e.column] -= scheme_.force * excess * e.value;
                     }
                   });
}

bool MonolithicStepper::move_rigid_rows() {
  if (rigid_.empty() || !rigid_.move(forces_.rigid)) return false;
  for (std::size_t k = 0; k < rigid_.stands().size(); ++k) {
    z_[first_rigid_ + static_cast<int>(k)] = scheme_.force * rigid_.stands()[k].force;
  }
  return true;
}

}  // namespace buckens::verification
