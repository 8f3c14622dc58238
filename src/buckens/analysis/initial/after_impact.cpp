// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/initial/after_impact.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "buckens/analysis/initial/impulses.h"
#include "buckens/analysis/initial/rigid_rows_start.h"
#include "buckens/base/errors.h"
#include "buckens/dynamics/constraints.h"
#include "buckens/dynamics/forces.h"
#include "buckens/dynamics/model_scales.h"
#include "buckens/spatial/rotation.h"
#include "buckens/stepping/rigid_rows.h"

namespace buckens::analysis {

using Vector6 = Eigen::Matrix<double, 6, 1>;

namespace {

// Gaps are small against the mechanism, so Newton's method doubles its digits each time.
constexpr int kMostClosings = 6;
constexpr double kClosedGap = 1e-13;  // of the model's length, or rad

/// Gives sampled blocks the states that they had before the samples at the end of a step.
void undo_samples(const model::Model& model, const model::State& before, linalg::Vector& blocks) {
  for (const model::Signal& signal : model.signals.all) {
    if (!signal.is_held()) continue;
    const int count = signal.block->num_states();
    blocks.segment(signal.first_state, count) =
        before.memory.blocks.segment(signal.first_state, count);
  }
}

}  // namespace

void close_rates(const model::Model& model, const std::vector<int>& rows_in_use,
                 const stepping::Stepper* meshes, model::State& state) {
  Impulses impulses(model, meshes);
  impulses.place(state, rows_in_use);
  if (!impulses.has_rows()) return;
  impulses.undo(impulses.rates(), [&](std::size_t b, const Impulses::Change& change) {
    model::BodyState& s = state.bodies[b];
    s.frame.w += change.frame.head<3>();
    s.frame.v += change.frame.tail<3>();
    if (change.mesh != nullptr) meshes->add_impulse(b, *change.mesh, s.d_dot);
  });
}

void close_gaps(const model::Model& model, const std::vector<int>& rows_in_use,
                const stepping::Stepper* meshes, model::State& state) {
  const linalg::Vector lengths = dynamics::row_lengths(model);
  Impulses impulses(model, meshes);
  for (int closing = 0; closing < kMostClosings; ++closing) {
    impulses.place(state, rows_in_use);
    double largest = 0.0;
    for (std::size_t k = 0; k < rows_in_use.size(); ++k) {
      largest = std::max(largest, std::abs(impulses.gaps()[k]) / lengths[rows_in_use[k]]);
    }
    if (largest <= kClosedGap) return;
    impulses.undo(impulses.gaps(), [&](std::size_t b, const Impulses::Change& change) {
      model::BodyState& s = state.bodies[b];
      s.frame.X_WB.p += change.frame.tail<3>();
      s.frame.X_WB.q =
          (s.frame.X_WB.q * spatial::exp_rotation(change.frame.head<3>())).normalized();
      if (change.mesh != nullptr) meshes->add_impulse(b, *change.mesh, s.d);
    });
  }
}

void settle_after_impact(const model::Model& model, const dynamics::MassMetric& metric,
                         const std::vector<int>& rows_in_use, const model::State& before,
                         double rest, model::State& state) {
  const bool is_rigid = std::none_of(model.bodies.begin(), model.bodies.end(),
                                     [](const body::Body& body) { return body.is_flexible(); });
  if (!is_rigid || !(rest > 0.0)) return settle_rigid_rows(model, metric, rows_in_use, state);
  const std::vector<model::BodyState> smooth = state.bodies;
  const linalg::Vector blocks = state.memory.blocks;
  undo_samples(model, before, state.memory.blocks);
  settle_rigid_rows(model, metric, rows_in_use, state);
  for (std::size_t b = 0; b < smooth.size(); ++b) {
    model::BodyState& s = state.bodies[b];
    const Eigen::Vector3d dw = rest * (s.w_dot - smooth[b].w_dot);
    const Eigen::Vector3d dv = rest * (s.v_dot - smooth[b].v_dot);
    s.frame.w += dw;
    s.frame.v += dv;
    s.frame.X_WB.p += 0.5 * rest * dv;
    s.frame.X_WB.q = (s.frame.X_WB.q * spatial::exp_rotation(0.5 * rest * dw)).normalized();
  }
  close_rates(model, rows_in_use, nullptr, state);
  state.memory.blocks = blocks;
  settle_rigid_rows(model, metric, rows_in_use, state);
}

}  // namespace buckens::analysis
