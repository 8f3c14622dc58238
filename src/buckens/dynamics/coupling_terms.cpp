// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/coupling_terms.h"

#include "buckens/dynamics/frame_equation.h"

namespace buckens::dynamics {

using Eigen::Vector3d;
using linalg::Vector;

model::Coupling evaluate_coupling(const body::Body& body, const Vector& d, const Vector& d_dot,
                                  const Vector& d_ddot, const Vector3d& w, const Vector3d& w_dot) {
  if (!body.is_flexible() || body.flexible->coupling == body::CouplingLevel::none) {
    return {undeformed_moments(body), {}};
  }
  const body::InertiaInvariants& invariants = body.flexible->invariants;
  return {invariants.moments(d, d_dot, d_ddot), invariants.deformation_load(d, d_dot, w, w_dot)};
}

model::Coupling extrapolate(const model::Coupling& now, const model::Coupling& before,
                            double ratio) {
  const auto ahead = [ratio](const auto& a, const auto& b) { return a + ratio * (a - b); };
  model::Coupling out;
  out.moments.J = ahead(now.moments.J, before.moments.J);
  out.moments.J_dot = ahead(now.moments.J_dot, before.moments.J_dot);
  out.moments.l = ahead(now.moments.l, before.moments.l);
  out.moments.l_dot = ahead(now.moments.l_dot, before.moments.l_dot);
  out.load = ahead(now.load, before.load);
  return out;
}

}  // namespace buckens::dynamics
