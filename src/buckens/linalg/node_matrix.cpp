// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/node_matrix.h"

#include "buckens/linalg/counted_entries.h"

namespace buckens::linalg {

NodeMatrix node_matrix(const SparseMatrix& A) {
  return {A.valuePtr(), A.innerIndexPtr(), A.outerIndexPtr(), static_cast<int>(A.outerSize())};
}

SparseMatrix of_variables(const SparseMatrix& A) {
  const auto visit = [&A](auto&& entry) {
    for (int node = 0; node < A.outerSize(); ++node) {
      for (int a = 0; a < 3; ++a) {
        for (SparseMatrix::InnerIterator it(A, node); it; ++it) {
          entry(3 * static_cast<int>(it.row()) + a, 3 * node + a, it.value());
        }
      }
    }
  };
  const int size = 3 * static_cast<int>(A.outerSize());
  return from_counted_entries(size, size, visit);
}

Vector of_variables(const Vector& of_nodes) {
  return of_nodes.transpose().replicate(3, 1).reshaped();
}

void multiply_by_node(const SparseMatrix& A, const double* x, double* y) {
  node_kernels().multiply(node_matrix(A), 0, static_cast<int>(A.outerSize()), x, y);
}

}  // namespace buckens::linalg
