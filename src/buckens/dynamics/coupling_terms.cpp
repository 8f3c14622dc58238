// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/coupling_terms.h"

#include <algorithm>
#include <array>

#include "buckens/dynamics/frame_equation.h"

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
  if (!body.is_flexible()) return out;
  const body::InertiaInvariants& invariants = body.flexible->invariants;
  if (terms.quad_ref) {
    out.moments = invariants.quadratic_moments(d, d_dot, d_ddot);
    if (!terms.jvar) out.moments.J.setZero();
    if (!terms.cor_ref) out.moments.J_dot.setZero();
  }
  if (terms.have_load()) out.load = invariants.deformation_load(d, d_dot, w, w_dot, terms);
  if (terms.stiffening && body.flexible->geometric) out.load += body.flexible->geometric->load(d);
  return out;
}

body::DeformedMoments frame_moments(const body::Body& body, const body::CouplingTerms& terms,
                                    const body::DeformedMoments& quadratic,
                                    const Eigen::VectorXd& z, const Eigen::VectorXd& z_dot) {
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

model::Coupling extrapolate(const model::BodyState& state, int history, double t) {
  const std::array<const model::Coupling*, 3> known = {&state.coupling, &state.coupling_before,
                                                       &state.coupling_earlier};
  auto count = static_cast<std::size_t>(std::clamp(history, 1, 3));
  // Instants close together tell nothing about those far ahead; after a change of step they occur.
  const double ahead = t - known[0]->t;
  for (std::size_t k = 1; k < count; ++k) {
    if (known[k - 1]->t - known[k]->t < kLeastSpacing * ahead) count = k;
  }
  model::Coupling out;
  for (std::size_t k = 0; k < count; ++k) {
    double weight = 1.0;  // Lagrange's polynomial
    for (std::size_t j = 0; j < count; ++j) {
      if (j != k) weight *= (t - known[j]->t) / (known[k]->t - known[j]->t);
    }
    const body::DeformedMoments& moments = known[k]->moments;
    out.moments.J += weight * moments.J;
    out.moments.J_dot += weight * moments.J_dot;
    out.moments.l += weight * moments.l;
    out.moments.l_dot += weight * moments.l_dot;
    if (k == 0) {
      out.load = weight * known[k]->load;
    } else {
      out.load += weight * known[k]->load;
    }
  }
  out.t = t;
  return out;
}

}  // namespace buckens::dynamics
