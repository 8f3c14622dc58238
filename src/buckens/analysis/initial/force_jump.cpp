// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/initial/force_jump.h"

namespace buckens::analysis {

void ForceJump::find_forces(const model::State& state, const std::vector<double>* signals) {
  dynamics::Circumstances around = dynamics::circumstances_of(state);
  around.signals = signals;
  dynamics::motions_of(model_, state, motions_);
  dynamics::evaluate_forces(model_, motions_, state.t, around, forces_);
}

void ForceJump::note(const model::State& state, const std::vector<double>* signals) {
  find_forces(state, signals);
  changes_.resize(model_.bodies.size());
  for (std::size_t b = 0; b < changes_.size(); ++b) {
    changes_[b].frame_load = -forces_.frame[b];
    changes_[b].interface_load = -forces_.interface[b];
  }
}

bool ForceJump::find_changes() {
  bool are_any = false;
  for (std::size_t b = 0; b < changes_.size(); ++b) {
    changes_[b].frame_load += forces_.frame[b];
    changes_[b].interface_load += forces_.interface[b];
    are_any =
        are_any || !changes_[b].frame_load.isZero(0.0) || !changes_[b].interface_load.isZero(0.0);
  }
  return are_any;
}

void ForceJump::pass(const stepping::Stepper& stepper, model::State& state) {
  find_forces(state, nullptr);
  if (!find_changes()) return;
  if (!rows_ || of_ != &stepper) rows_.emplace(model_, &stepper);
  of_ = &stepper;
  rows_->place(state, stepper.rows_in_use());
  rows_->add(changes_, [&](std::size_t b, const Impulses::Change& change) {
    model::BodyState& s = state.bodies[b];
    for (Eigen::Vector3d* w_dot : {&s.w_dot, &s.w_alg}) *w_dot += change.frame.head<3>();
    for (Eigen::Vector3d* v_dot : {&s.v_dot, &s.v_alg}) *v_dot += change.frame.tail<3>();
    if (change.mesh == nullptr) return;
    for (linalg::NodalVector* d_ddot : {&s.d_ddot, &s.d_alg}) {
      stepper.add_impulse(b, *change.mesh, *d_ddot);
    }
  });
}

}  // namespace buckens::analysis
