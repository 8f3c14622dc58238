// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/initial/after_impact.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

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

/// What impulses along rows of joints and closed rigid rows do, at one configuration.
class Impulses {
 public:
  Impulses(const model::Model& model, const std::vector<int>& rows_in_use,
           const stepping::Stepper* meshes, const model::State& state)
      : model_(model), t_(state.t), interface_(model.bodies.size()) {
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      if (meshes != nullptr) interface_[b] = meshes->impulse_compliance(b);
      compliance_.push_back({dynamics::frame_mobility(model.bodies[b], model.bodies[b].J0),
                             interface_[b].size() > 0 ? &interface_[b] : nullptr});
    }
    const auto motions = dynamics::motions_of(model, state);
    dynamics::Constraints joints;
    dynamics::evaluate_constraints(model, motions, state.t, &state.memory, joints);
    for (const int row : rows_in_use) {
      rows_.push_back(joints.rows[static_cast<std::size_t>(row)]);
      gaps_.push_back(joints.g[row]);
      rates_.push_back(joints.g_dot[row]);
    }
    dynamics::SoftRows soft;
    dynamics::evaluate_soft_rows(model, motions, state.t, dynamics::circumstances_of(state), soft);
    for (std::size_t k = 0; k < soft.rows.size(); ++k) {
      if (soft.is_closed[k]) add_rigid_row(soft.rows[k], motions);
    }
  }

  bool has_rows() const { return !rows_.empty(); }
  /// Of joints; rigid rows stay where they are.
  const std::vector<double>& gaps() const { return gaps_; }
  const std::vector<double>& rates() const { return rates_; }

  /// Finds the impulses that change the rows by −`values`, and passes what each body does to
  /// `take(b, change of its frame, change of its mesh)`; the mesh is null where it does not move.
  template <class Take>
  void undo(const std::vector<double>& values, Take&& take) {
    dynamics::MultiplierCondensation condensation(static_cast<int>(model_.bodies.size()), rows_);
    if (!stepping::factorise_closed_rows(condensation, rows_, compliance_, give_)) {
      throw NumericalError(fmt::format(
          "the joint equations have become dependent after an impact at t = {:.6g} s (a singular "
          "position); check whether the mechanism is at a dead centre there",
          t_));
    }
    linalg::Vector X = -Eigen::Map<const linalg::Vector>(values.data(), std::ssize(values));
    condensation.solve_in_place(X);
    std::vector<dynamics::BodyResponse> responses(model_.bodies.size());
    for (std::size_t b = 0; b < responses.size(); ++b) {
      responses[b].interface_load.setZero(model_.bodies[b].num_interface_rows());
    }
    condensation.gather(X, responses);
    for (std::size_t b = 0; b < responses.size(); ++b) {
      const Vector6 frame = compliance_[b].frame * responses[b].frame_load;
      const bool deforms = interface_[b].size() > 0;
      take(b, frame, deforms ? &responses[b].interface_load : nullptr);
    }
  }

 private:
  void add_rigid_row(const dynamics::SystemRow& row,
                     const std::vector<dynamics::BodyMotion>& motions) {
    give_.push_back(stepping::kRigidGive * stepping::own_compliance(row, compliance_));
    double rate = 0;
    for (const dynamics::BodyRow* part : {&row.first, &row.second}) {
      if (part->body != model::kGround) {
        rate += part->rate(motions[static_cast<std::size_t>(part->body)]);
      }
    }
    rows_.push_back(row);
    gaps_.push_back(0.0);
    rates_.push_back(rate);
  }

  const model::Model& model_;
  double t_;
  std::vector<linalg::Matrix> interface_;
  std::vector<dynamics::BodyCompliance> compliance_;
  std::vector<dynamics::SystemRow> rows_;
  std::vector<double> gaps_, rates_, give_;
};

/// Gives sampled blocks the states that they had before the samples at the end of a step.
void undo_samples(const model::Model& model, const model::State& before, linalg::Vector& blocks) {
  for (const model::Signal& signal : model.signals.all) {
    if (!signal.is_sampled() && !(signal.block && signal.block->samples_each_step())) continue;
    const int count = signal.block->num_states();
    blocks.segment(signal.first_state, count) =
        before.memory.blocks.segment(signal.first_state, count);
  }
}

}  // namespace

void close_rates(const model::Model& model, const std::vector<int>& rows_in_use,
                 const stepping::Stepper* meshes, model::State& state) {
  Impulses impulses(model, rows_in_use, meshes, state);
  if (!impulses.has_rows()) return;
  impulses.undo(impulses.rates(), [&](std::size_t b, const Vector6& frame, const auto* mesh) {
    model::BodyState& s = state.bodies[b];
    s.frame.w += frame.head<3>();
    s.frame.v += frame.tail<3>();
    if (mesh != nullptr) meshes->add_impulse(b, *mesh, s.d_dot);
  });
}

void close_gaps(const model::Model& model, const std::vector<int>& rows_in_use,
                const stepping::Stepper* meshes, model::State& state) {
  const linalg::Vector lengths = dynamics::row_lengths(model);
  for (int closing = 0; closing < kMostClosings; ++closing) {
    Impulses impulses(model, rows_in_use, meshes, state);
    double largest = 0.0;
    for (std::size_t k = 0; k < rows_in_use.size(); ++k) {
      largest = std::max(largest, std::abs(impulses.gaps()[k]) / lengths[rows_in_use[k]]);
    }
    if (largest <= kClosedGap) return;
    impulses.undo(impulses.gaps(), [&](std::size_t b, const Vector6& frame, const auto* mesh) {
      model::BodyState& s = state.bodies[b];
      s.frame.X_WB.p += frame.tail<3>();
      s.frame.X_WB.q = (s.frame.X_WB.q * spatial::exp_rotation(frame.head<3>())).normalized();
      if (mesh != nullptr) meshes->add_impulse(b, *mesh, s.d);
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
