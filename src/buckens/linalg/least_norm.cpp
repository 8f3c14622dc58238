// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/least_norm.h"

#include <algorithm>
#include <cmath>

#include "buckens/base/errors.h"
#include "buckens/linalg/single_thread.h"
#include "buckens/linalg/spqr_matrix.h"

namespace buckens::linalg {

namespace {

using Factorisation = SuiteSparseQR_factorization<double>;

/// Objects of CHOLMOD and SPQR that belong to one solution.
struct Solution {
  explicit Solution(cholmod_common& workspace) : common(&workspace) {}
  ~Solution() {
    if (x != nullptr) cholmod_l_free_dense(&x, common);
    if (y != nullptr) cholmod_l_free_dense(&y, common);
    if (factorisation != nullptr) SuiteSparseQR_free<double>(&factorisation, common);
  }
  Solution(const Solution&) = delete;
  Solution& operator=(const Solution&) = delete;

  cholmod_common* common;
  Factorisation* factorisation = nullptr;
  cholmod_dense* y = nullptr;
  cholmod_dense* x = nullptr;
};

}  // namespace

Vector least_norm_solution(const SparseMatrix& A, const Vector& b, double tolerance) {
  if (A.cols() == 0 || A.rows() == 0) return Vector::Zero(A.cols());
  const SparseMatrix equations = A.transpose();  // a column each
  double longest = 0.0;
  for (int k = 0; k < equations.outerSize(); ++k) {
    longest = std::max(longest, equations.col(k).norm());
  }
  const SingleThread alone;
  SpqrMatrix matrix(equations);
  Vector right = b;
  cholmod_dense column{};
  column.nrow = column.d = column.nzmax = static_cast<std::size_t>(right.size());
  column.ncol = 1;
  column.x = right.data();
  column.xtype = CHOLMOD_REAL;
  column.dtype = CHOLMOD_DOUBLE;
  Solution solution(matrix.common);
  solution.factorisation = SuiteSparseQR_factorize<double>(
      SPQR_ORDERING_DEFAULT, tolerance * longest, &matrix.view, &matrix.common);
  if (solution.factorisation != nullptr) {
    solution.y = SuiteSparseQR_solve<double>(SPQR_RTX_EQUALS_ETB, solution.factorisation, &column,
                                             &matrix.common);
  }
  if (solution.y != nullptr) {
    solution.x =
        SuiteSparseQR_qmult<double>(SPQR_QX, solution.factorisation, solution.y, &matrix.common);
  }
  if (solution.x == nullptr) {
    throw NumericalError("forces of redundant joints could not be shared out: " + matrix.failure());
  }
  return Eigen::Map<const Vector>(static_cast<const double*>(solution.x->x), A.cols());
}

}  // namespace buckens::linalg
