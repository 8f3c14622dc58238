// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/sparse_cholesky.h"

#include <algorithm>
#include <string>

#include <cholmod.h>

#include "buckens/base/errors.h"

namespace buckens::linalg {

struct SparseCholesky::Backend {
  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  // Workspace that cholmod_solve2 keeps between calls.
  cholmod_dense* solution = nullptr;
  cholmod_dense* work_y = nullptr;
  cholmod_dense* work_e = nullptr;

  Backend() {
    cholmod_start(&common);
    common.print = 0;
    common.final_ll = 1;  // L Lᵀ also for small matrices: L D Lᵀ would accept indefinite ones
  }
  ~Backend() {
    cholmod_free_dense(&solution, &common);
    cholmod_free_dense(&work_y, &common);
    cholmod_free_dense(&work_e, &common);
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  Backend(const Backend&) = delete;
  Backend& operator=(const Backend&) = delete;

  void solve(const double* rhs, double* x, Eigen::Index rows, Eigen::Index columns) {
    cholmod_dense b{};
    b.nrow = static_cast<std::size_t>(rows);
    b.ncol = static_cast<std::size_t>(columns);
    b.nzmax = b.nrow * b.ncol;
    b.d = b.nrow;
    b.x = const_cast<double*>(rhs);  // CHOLMOD reads it only
    b.xtype = CHOLMOD_REAL;
    b.dtype = CHOLMOD_DOUBLE;
    if (cholmod_solve2(CHOLMOD_A, factor, &b, nullptr, &solution, nullptr, &work_y, &work_e,
                       &common) == 0) {
      throw NumericalError("a sparse solve failed (CHOLMOD status " +
                           std::to_string(common.status) + "); is there enough memory?");
    }
    const double* values = static_cast<const double*>(solution->x);
    std::copy(values, values + rows * columns, x);
  }
};

SparseCholesky::SparseCholesky(const SparseMatrix& A) : backend_(std::make_unique<Backend>()) {
  SparseMatrix lower = A.triangularView<Eigen::Lower>();
  lower.makeCompressed();
  cholmod_sparse view{};
  view.nrow = static_cast<std::size_t>(lower.rows());
  view.ncol = static_cast<std::size_t>(lower.cols());
  view.nzmax = static_cast<std::size_t>(lower.nonZeros());
  view.p = lower.outerIndexPtr();
  view.i = lower.innerIndexPtr();
  view.x = lower.valuePtr();
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  backend_->factor = cholmod_analyze(&view, &backend_->common);
  if (backend_->factor == nullptr) {
    throw NumericalError("a sparse factorisation ran out of memory; use a coarser mesh");
  }
  cholmod_factorize(&view, backend_->factor, &backend_->common);
  if (backend_->common.status != CHOLMOD_OK || backend_->factor->minor < view.nrow) {
    throw NumericalError(
        "a matrix of size " + std::to_string(lower.rows()) + " is not positive definite (column " +
        std::to_string(backend_->factor->minor) + "); check masses and materials of the body");
  }
}

SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

Eigen::Index SparseCholesky::size() const { return static_cast<Eigen::Index>(backend_->factor->n); }

double SparseCholesky::num_factor_entries() const { return backend_->common.lnz; }

void SparseCholesky::solve_in_place(Vector& x) const {
  backend_->solve(x.data(), x.data(), x.size(), 1);
}

Matrix SparseCholesky::solve(const Matrix& B) const {
  Matrix X(B.rows(), B.cols());
  if (B.cols() > 0) backend_->solve(B.data(), X.data(), B.rows(), B.cols());
  return X;
}

}  // namespace buckens::linalg
