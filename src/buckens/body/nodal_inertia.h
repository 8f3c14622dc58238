// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/base/task_pool.h"
#include "buckens/fem/element/shape_integrals.h"
#include "buckens/linalg/node_matrix.h"

namespace buckens::body {

/// The part of the inertia integrals given by a scalar mass matrix: W_ab = Ms ⊗ E_ab.
///
/// Nodal vectors are viewed as 3×N arrays, so that xᵀW_ab y = (X Ms Yᵀ)_ab for all nine pairs at
/// once and Σ A_ab W_ab x = A X Ms: one product with Ms instead of nine with W.
///
/// Where the variables are numbered node by node, three each, as in solids without constraints,
/// products need no lookup except of the entries of Ms.
class NodalInertia {
 public:
  explicit NodalInertia(const fem::NodalMass& mass);
  /// Reads another copy of the matrix in products, which several bodies have in common.
  /// @pre is_regular()
  void read_from(const linalg::SharedMatrix& copy) { read_ = copy; }

  bool empty() const { return mass_->empty(); }
  /// x as an array with one column of translations per node, zeros where there is no DOF.
  Eigen::Matrix3Xd by_node(const linalg::Vector& x) const;
  /// X Ms, one column per node.
  Eigen::Matrix3Xd times_mass(const linalg::Vector& x) const;
  /// y ← y + Y, node by node.
  void add(const Eigen::Matrix3Xd& by_node, linalg::Vector& y) const;
  /// y = (Ms ⊗ 1) x, zero where no node has the variable. Allocates nothing.
  /// @param pool processes nodes in parallel, with the same result
  void multiply(const linalg::Vector& x, linalg::Vector& y, TaskPool* pool = nullptr) const;

  /// Whether node k has the variables 3k, 3k + 1, 3k + 2.
  bool is_regular() const { return is_regular_; }
  const fem::NodalMass& mass() const { return *mass_; }
  /// @pre is_regular()
  linalg::NodeMatrix matrix() const { return linalg::node_matrix(*read_); }

 private:
  const fem::NodalMass* mass_;
  bool is_regular_;
  linalg::SharedMatrix read_;
};

}  // namespace buckens::body
