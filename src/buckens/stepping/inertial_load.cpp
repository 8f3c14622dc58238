// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/inertial_load.h"

#include <cmath>

#include "buckens/linalg/inverse_iteration.h"
#include "buckens/linalg/matrix_sum.h"

namespace buckens::stepping {

using linalg::Vector;

namespace {

// Entries of C and of M are sums of a few numbers each.
constexpr double kProportional = 1e-14;

/// Whether M is the scalar mass matrix, node by node.
bool acts_by_node(const body::FlexiblePart& part, const body::NodalInertia& nodal) {
  if (nodal.empty()) return false;
  if (!nodal.mass().Ms.is_here()) return true;  // only such bodies let go of it
  const Vector x = linalg::scattered_block(part.num_dofs(), 1, 5);
  Vector y(x.size());
  nodal.multiply(x, y);
  const Vector expected = part.fe.M * x;
  return (y - expected).norm() <= kProportional * expected.norm();
}

}  // namespace

std::optional<double> stiffness_damping(const body::FlexiblePart& part) {
  if (!part.is_damped()) return std::nullopt;
  linalg::MatrixSum stiffness;
  stiffness.add(1.0, part.fe.K);
  const double size = linalg::inner_product(stiffness, stiffness);
  if (!(size > 0.0)) return std::nullopt;
  const auto rest = [&part](double beta) {
    linalg::MatrixSum sum;
    sum.add(1.0, part.C);
    sum.add(-part.fe.mass_damping, part.fe.M);
    sum.add(-beta, part.fe.K);
    return sum;
  };
  double beta = 0;
  for (int pass = 0; pass < 2; ++pass) {  // the second takes the rounding of a long sum out
    beta += linalg::inner_product(rest(beta), stiffness) / size;
  }
  const linalg::MatrixSum left = rest(beta);
  if (std::sqrt(linalg::inner_product(left, left)) > kProportional * part.C.norm()) {
    return std::nullopt;
  }
  return beta;
}

InertialLoad::InertialLoad(const body::FlexiblePart& part, const Scheme& scheme)
    : part_(&part), nodal_(part.fe.shape.nodal), is_by_node_(acts_by_node(part, nodal_)) {
  if (!part.is_damped()) return;
  const std::optional<double> beta = stiffness_damping(part);
  if (!beta) return;
  is_proportional_ = true;
  const double alpha = part.fe.mass_damping;
  share_ = *beta / (scheme.stiffness + scheme.damping * *beta);
  zeta_ = alpha - share_ * (scheme.mass + scheme.damping * alpha);
}

void InertialLoad::multiply_mass(const Vector& x, Vector& y, TaskPool* pool) const {
  y.resize(x.size());
  if (is_by_node_) {
    nodal_.multiply(x, y, pool);
  } else {
    linalg::multiply({{&part_->fe.M, &x, &y}});
  }
}

void InertialLoad::multiply(const Vector& a, const Vector& b, Vector& y, TaskPool* pool) const {
  if (is_by_node_ || !part_->C.is_divided()) {
    multiply_mass(a, y, pool);
    part_->C.add_product(b, y);
    return;
  }
  Vector damping;
  linalg::multiply({{&part_->fe.M, &a, &y}, {&part_->C, &b, &damping}});
  y += damping;
}

}  // namespace buckens::stepping
