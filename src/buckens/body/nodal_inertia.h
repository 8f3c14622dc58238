// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/fem/shape_integrals.h"

namespace buckens::body {

/// The share of the inertia integrals that a scalar mass matrix holds: W_ab = Ms ⊗ E_ab.
///
/// Nodal vectors are looked at as 3×N arrays, so that xᵀW_ab y = (X Ms Yᵀ)_ab for all nine pairs at
/// once and Σ A_ab W_ab x = A X Ms: one product with Ms in place of nine with W.
class NodalInertia {
 public:
  explicit NodalInertia(const fem::NodalMass& mass) : mass_(&mass) {}

  bool empty() const { return mass_->empty(); }
  /// x as an array with one column of translations per node, zeros where there is no DOF.
  Eigen::Matrix3Xd by_node(const linalg::Vector& x) const;
  /// X Ms, one column per node.
  Eigen::Matrix3Xd times_mass(const linalg::Vector& x) const;
  /// y ← y + Y, node by node.
  void add(const Eigen::Matrix3Xd& by_node, linalg::Vector& y) const;
  /// y = (Ms ⊗ 1) x, zero where no node has the variable. Allocates nothing.
  void multiply(const linalg::Vector& x, linalg::Vector& y) const;

 private:
  const fem::NodalMass* mass_;
};

}  // namespace buckens::body
