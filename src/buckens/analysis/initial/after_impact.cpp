// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/initial/after_impact.h"

#include <algorithm>

#include <fmt/format.h>

#include "buckens/analysis/initial/rigid_rows_start.h"
#include "buckens/base/errors.h"
#include "buckens/dynamics/constraints.h"
#include "buckens/dynamics/forces.h"
#include "buckens/spatial/rotation.h"
#include "buckens/stepping/rigid_rows.h"

namespace buckens::analysis {

void close_rates(const model::Model& model, const std::vector<int>& rows_in_use,
                 const dynamics::MassMetric& metric, Inertia inertia, model::State& state) {
  const bool with_meshes = inertia == Inertia::frames_and_meshes;
  const auto motions = dynamics::motions_of(model, state);
  dynamics::Constraints joints;
  dynamics::evaluate_constraints(model, motions, state.t, &state.memory, joints);
  dynamics::SoftRows soft;
  dynamics::evaluate_soft_rows(model, motions, state.t, dynamics::circumstances_of(state), soft);
  std::vector<dynamics::SystemRow> rows;
  std::vector<double> rates, give;
  std::vector<Eigen::Matrix3d> J;
  for (const body::Body& body : model.bodies) J.push_back(body.J0);
  const auto compliance = with_meshes ? metric.full(J) : metric.rigid();
  for (const int row : rows_in_use) {
    rows.push_back(joints.rows[static_cast<std::size_t>(row)]);
    rates.push_back(joints.g_dot[row]);
  }
  for (std::size_t k = 0; k < soft.rows.size(); ++k) {
    if (!soft.is_closed[k]) continue;
    rows.push_back(soft.rows[k]);
    give.push_back(stepping::kRigidGive * stepping::own_compliance(soft.rows[k], compliance));
    double rate = 0;
    for (const dynamics::BodyRow* part : {&soft.rows[k].first, &soft.rows[k].second}) {
      if (part->body != model::kGround) {
        rate += part->rate(motions[static_cast<std::size_t>(part->body)]);
      }
    }
    rates.push_back(rate);
  }
  if (rows.empty()) return;
  dynamics::MultiplierCondensation condensation(static_cast<int>(model.bodies.size()), rows);
  if (!condensation.factorise(rows, rows, compliance, {}) &&
      !condensation.factorise(rows, rows, compliance, give)) {
    throw NumericalError(
        fmt::format("the joint equations have become dependent (a singular position) after an "
                    "impact at t = {:.6g} s; look for a dead centre of the mechanism there",
                    state.t));
  }
  linalg::Vector X = -Eigen::Map<const linalg::Vector>(rates.data(), std::ssize(rates));
  condensation.solve_in_place(X);
  std::vector<dynamics::BodyResponse> responses(model.bodies.size());
  for (std::size_t b = 0; b < responses.size(); ++b) {
    responses[b].interface_load.setZero(model.bodies[b].num_interface_rows());
  }
  condensation.gather(X, responses);
  for (std::size_t b = 0; b < responses.size(); ++b) {
    const Eigen::Matrix<double, 6, 1> change = compliance[b].frame * responses[b].frame_load;
    state.bodies[b].frame.w += change.head<3>();
    state.bodies[b].frame.v += change.tail<3>();
    const body::Body& body = model.bodies[b];
    if (with_meshes && body.is_flexible() && !body.flexible->is_quasi_static) {
      state.bodies[b].d_dot += metric.H(b) * responses[b].interface_load;
    }
  }
}

void settle_after_impact(const model::Model& model, const dynamics::MassMetric& metric,
                         const std::vector<int>& rows_in_use, double rest, model::State& state) {
  const bool is_rigid = std::none_of(model.bodies.begin(), model.bodies.end(),
                                     [](const body::Body& body) { return body.is_flexible(); });
  std::vector<model::BodyState> smooth;
  if (is_rigid && rest > 0.0) smooth = state.bodies;
  settle_rigid_rows(model, metric, rows_in_use, state);
  if (smooth.empty()) return;
  for (std::size_t b = 0; b < smooth.size(); ++b) {
    model::BodyState& s = state.bodies[b];
    const Eigen::Vector3d dw = rest * (s.w_dot - smooth[b].w_dot);
    const Eigen::Vector3d dv = rest * (s.v_dot - smooth[b].v_dot);
    s.frame.w += dw;
    s.frame.v += dv;
    s.frame.X_WB.p += 0.5 * rest * dv;
    s.frame.X_WB.q = (s.frame.X_WB.q * spatial::exp_rotation(0.5 * rest * dw)).normalized();
  }
  close_rates(model, rows_in_use, metric, Inertia::frames, state);
  settle_rigid_rows(model, metric, rows_in_use, state);
}

}  // namespace buckens::analysis
