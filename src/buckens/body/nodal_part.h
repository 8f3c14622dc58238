// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/body/nodal_recovery.h"

namespace buckens::body {

/// Some nodal variables of a mesh from the variables of the equations of motion on which they
/// depend: rows of T, with the bits of NodalRecovery::apply().
class NodalPart {
 public:
  NodalPart() = default;
  /// @param T must outlive it
  /// @param nodal variables of the mesh, ascending
  NodalPart(const NodalRecovery& T, std::vector<int> nodal);

  /// Variables of the equations of motion that are read, ascending.
  const std::vector<int>& variables() const { return variables_; }
  /// @param x of variables()
  linalg::Vector apply(const linalg::Vector& x) const;

 private:
  void take_rows(const linalg::SparseMatrix& T, const std::vector<int>& nodal);
  linalg::Vector apply_dense(const linalg::Vector& x) const;

  std::vector<int> variables_;
  linalg::SparseMatrix rows_;  // of a sparse T: columns of variables_
  const linalg::Matrix* dense_ = nullptr;
  std::vector<int> nodal_;  // of a dense T
};

}  // namespace buckens::body
