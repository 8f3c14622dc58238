// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/spqr.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include <SuiteSparseQR.hpp>

#include "buckens/base/errors.h"
#include "buckens/linalg/single_thread.h"

namespace buckens::linalg {

namespace {

/// Copy of a matrix in the long indices that SPQR takes, with SPQR's workspace.
struct SpqrMatrix {
  explicit SpqrMatrix(const SparseMatrix& A)
      : starts(A.outerIndexPtr(), A.outerIndexPtr() + A.cols() + 1),
        rows(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros()),
        values(A.valuePtr(), A.valuePtr() + A.nonZeros()) {
    cholmod_l_start(&common);
    common.print = 0;
    view.nrow = static_cast<std::size_t>(A.rows());
    view.ncol = static_cast<std::size_t>(A.cols());
    view.nzmax = values.size();
    view.p = starts.data();
    view.i = rows.data();
    view.x = values.data();
    view.itype = CHOLMOD_LONG;
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    view.sorted = 1;
    view.packed = 1;
  }
  ~SpqrMatrix() { cholmod_l_finish(&common); }
  SpqrMatrix(const SpqrMatrix&) = delete;
  SpqrMatrix& operator=(const SpqrMatrix&) = delete;

  /// Why SPQR failed, and what to do.
  std::string failure() const {
    const std::string size = std::to_string(view.nrow) + " × " + std::to_string(view.ncol);
    if (common.status == CHOLMOD_OUT_OF_MEMORY) {
      return "there is not enough memory for a QR factor of a matrix of size " + size +
             "; use fewer joints or frames";
    }
    return "SPQR refused a matrix of size " + size + " (status " + std::to_string(common.status) +
           "); please report this with the model";
  }

  std::vector<SuiteSparse_long> starts, rows;
  std::vector<double> values;
  cholmod_sparse view{};
  cholmod_common common{};
};

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

/// With a tolerance R is a staircase in which every independent column steps down.
RowRank split_columns_by_spqr(const SparseMatrix& A, double limit) {
  const SingleThread alone;
  SpqrMatrix matrix(A);
  cholmod_sparse* R = nullptr;
  SuiteSparse_long* permutation = nullptr;
  SuiteSparseQR<double>(SPQR_ORDERING_DEFAULT, limit, A.cols(), &matrix.view, &R, &permutation,
                        &matrix.common);
  if (R == nullptr) {
    throw NumericalError("the rank of the joint equations could not be found: " + matrix.failure());
  }
  RowRank out;
  const auto* starts = static_cast<const SuiteSparse_long*>(R->p);
  const auto* rows = static_cast<const SuiteSparse_long*>(R->i);
  SuiteSparse_long next = 0;
  for (Eigen::Index k = 0; k < A.cols(); ++k) {
    bool steps_down = false;
    for (auto entry = starts[k]; entry < starts[k + 1]; ++entry) {
      steps_down = steps_down || rows[entry] == next;
    }
    const int column = static_cast<int>(permutation != nullptr ? permutation[k] : k);
    (steps_down ? out.independent : out.dependent).push_back(column);
    if (steps_down) ++next;
  }
  cholmod_l_free_sparse(&R, &matrix.common);
  cholmod_l_free(static_cast<std::size_t>(A.cols()), sizeof(SuiteSparse_long), permutation,
                 &matrix.common);
  std::sort(out.independent.begin(), out.independent.end());
  std::sort(out.dependent.begin(), out.dependent.end());
  return out;
}

Vector least_norm_by_spqr(const SparseMatrix& A, const Vector& b, double limit) {
  const SingleThread alone;
  SpqrMatrix matrix(A);
  Vector right = b;
  cholmod_dense column{};
  column.nrow = column.d = column.nzmax = static_cast<std::size_t>(right.size());
  column.ncol = 1;
  column.x = right.data();
  column.xtype = CHOLMOD_REAL;
  column.dtype = CHOLMOD_DOUBLE;
  Solution solution(matrix.common);
  solution.factorisation =
      SuiteSparseQR_factorize<double>(SPQR_ORDERING_DEFAULT, limit, &matrix.view, &matrix.common);
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
  return Eigen::Map<const Vector>(static_cast<const double*>(solution.x->x), A.rows());
}

}  // namespace buckens::linalg
