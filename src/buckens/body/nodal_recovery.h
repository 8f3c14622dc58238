// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>

#include "buckens/linalg/matrix_types.h"

namespace buckens::body {

/// Maps the variables of the equations of motion to the nodal variables of the mesh: d = T x.
///
/// T is the identity, sparse if nodes were eliminated (rigid regions), or dense if the body was
/// reduced to a basis.
class NodalRecovery {
 public:
  /// The identity.
  NodalRecovery() = default;
  explicit NodalRecovery(linalg::SparseMatrix T) : T_(std::move(T)) {}
  explicit NodalRecovery(linalg::Matrix Z) : T_(std::move(Z)) {}

  bool is_identity() const { return std::holds_alternative<std::monostate>(T_); }
  bool is_dense() const { return std::holds_alternative<linalg::Matrix>(T_); }
  /// T if it is dense.
  const linalg::Matrix& dense() const { return std::get<linalg::Matrix>(T_); }
  /// T if it is sparse.
  const linalg::SparseMatrix& sparse() const { return std::get<linalg::SparseMatrix>(T_); }

  /// T x.
  linalg::Vector apply(const linalg::Vector& x) const;
  /// Tᵀ f: loads on nodal variables as loads on x.
  linalg::Vector transposed(const linalg::Vector& f) const;
  /// The map T Z of variables x = Z η.
  NodalRecovery of(const linalg::Matrix& Z) const;
  /// N T for rows over nodal variables.
  Eigen::SparseMatrix<double, Eigen::RowMajor> rows(
      const Eigen::SparseMatrix<double, Eigen::RowMajor>& N) const;
  /// Largest of scale_i |T_ij| per column: the size of one unit of each variable.
  linalg::Vector column_sizes(const linalg::Vector& scale) const;

 private:
  std::variant<std::monostate, linalg::SparseMatrix, linalg::Matrix> T_;
};

}  // namespace buckens::body
