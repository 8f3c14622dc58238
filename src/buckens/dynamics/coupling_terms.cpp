// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/coupling_terms.h"

#include <algorithm>

#include "buckens/body/deformation_coupling.h"
#include "buckens/dynamics/frame_equation.h"
#include "buckens/linalg/row_parts.h"

namespace buckens::dynamics {

using Eigen::Vector3d;
using linalg::Vector;

namespace {
constexpr double kLeastSpacing = 0.2;  // relative to the distance that is extrapolated
}  // namespace

model::Coupling evaluate_coupling(const body::Body& body, const body::CouplingTerms& terms,
                                  const Vector& d, const Vector& d_dot, const Vector& d_ddot,
                                  const Vector3d& w, const Vector3d& w_dot) {
  model::Coupling out;
  evaluate_coupling(body, terms, d, d_dot, d_ddot, w, w_dot, out);
  return out;
}

void evaluate_coupling(const body::Body& body, const body::CouplingTerms& terms, const Vector& d,
                       const Vector& d_dot, const Vector& d_ddot, const Vector3d& w,
                       const Vector3d& w_dot, model::Coupling& out, TaskPool* pool,
                       const linalg::CommonTable* common) {
  out.t = 0;
  out.moments = {};
  Vector& load = out.load.overwrite(terms.have_load() ? d.size() : 0);
  body::DeformationWeights weights;
  if (body.is_flexible() && terms.have_load()) {
    weights = body::DeformationWeights::of_motion(w, w_dot, terms);
  }
  if (weights.are_zero()) load.setZero();
  if (!body.is_flexible()) return;
  const body::FlexiblePart& part = *body.flexible;
  if (terms.quad_ref || !weights.are_zero()) {
    const body::DeformedMoments moments = body::evaluate_deformation(
        part.fe.shape, d, d_dot, d_ddot, weights, load, pool, common, true);
    if (terms.quad_ref) out.moments = moments;
  }
  if (!terms.jvar) out.moments.J.setZero();
  if (!terms.cor_ref) out.moments.J_dot.setZero();
  if (terms.stiffening && part.geometric) load += part.geometric->load(d);
}

body::DeformedMoments frame_moments(const body::Body& body, const body::CouplingTerms& terms,
                                    const body::DeformedMoments& quadratic,
                                    const Eigen::Matrix<double, 6, 1>& z,
                                    const Eigen::Matrix<double, 6, 1>& z_dot) {
  body::DeformedMoments out = quadratic;
  out.J += body.J0;
  if (terms.jvar) out.J += body::InertiaInvariants::linear_inertia(z);
  if (terms.cor_ref) out.J_dot += body::InertiaInvariants::linear_inertia(z_dot);
  return out;
}

Eigen::Matrix<double, 6, 1> centrifugal_weights(const body::CouplingTerms& terms,
                                                const Vector3d& w) {
  if (!terms.cent0) return Eigen::Matrix<double, 6, 1>::Zero();
  return body::InertiaInvariants::centrifugal_weights(w);
}

Extrapolation extrapolation_of(const model::BodyState& state, int history, double t) {
  Extrapolation out;
  out.known = {&state.coupling, &state.coupling_before, &state.coupling_earlier};
  const auto& known = out.known;
  auto count = static_cast<std::size_t>(std::clamp(history, 1, 3));
  // Instants close together do not predict those far ahead; they occur after a change of step.
  const double ahead = t - known[0]->t;
  for (std::size_t k = 1; k < count; ++k) {
    if (known[k - 1]->t - known[k]->t < kLeastSpacing * ahead) count = k;
  }
  out.count = count;
  for (std::size_t k = 0; k < count; ++k) {
    out.weights[k] = 1.0;  // Lagrange's polynomial
    for (std::size_t j = 0; j < count; ++j) {
      if (j != k) out.weights[k] *= (t - known[j]->t) / (known[k]->t - known[j]->t);
    }
    const body::DeformedMoments& moments = known[k]->moments;
    out.moments.J += out.weights[k] * moments.J;
    out.moments.J_dot += out.weights[k] * moments.J_dot;
    out.moments.l += out.weights[k] * moments.l;
    out.moments.l_dot += out.weights[k] * moments.l_dot;
  }
  return out;
}

void extrapolate(const model::BodyState& state, int history, double t, model::Coupling& out,
                 TaskPool* pool) {
  const Extrapolation plan = extrapolation_of(state, history, t);
  out.moments = plan.moments;
  std::array<const Vector*, 3> known_loads{};
  for (std::size_t k = 0; k < plan.count; ++k) known_loads[k] = &plan.known[k]->load.whole();
  Vector& whole = out.load.overwrite(known_loads[0]->size());
  const linalg::RowParts rows(whole.size());
  rows.for_pieces(pool, [&](int /*part*/, Eigen::Index first, Eigen::Index size) {
    auto load = whole.segment(first, size);
    load = plan.weights[0] * known_loads[0]->segment(first, size);
    for (std::size_t k = 1; k < plan.count; ++k) {
      load += plan.weights[k] * known_loads[k]->segment(first, size);
    }
  });
  out.t = t;
}

}  // namespace buckens::dynamics
