// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/sparse_cholesky.h"

#include <algorithm>
#include <mutex>
#include <optional>
#include <string>

#include <cblas.h>
#include <cholmod.h>

#include "buckens/base/errors.h"
#include "buckens/linalg/blas_kernels.h"
#include "buckens/linalg/panel_factor.h"

namespace buckens::linalg {

namespace {

// Below this size orderings differ by too little to try several.
constexpr Eigen::Index kLarge = 3000;

cholmod_sparse view_of_lower(SparseMatrix& lower) {
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
  return view;
}

[[noreturn]] void throw_out_of_memory(Eigen::Index size) {
  throw NumericalError("there is not enough memory to factorise a matrix of size " +
                       std::to_string(size) + "; use a coarser mesh");
}

}  // namespace

struct SparseCholesky::Backend {
  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  std::optional<PanelFactor> panels;
  Eigen::Index size = 0;
  double entries = 0;

  std::mutex turn;  // guards what follows and `common`
  PanelFactor::Workspace workspace;
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

  void factorise(const SparseMatrix& A, const CholeskyOptions& options);
  void lay_out(SimdLevel simd);
  void solve(const double* rhs, double* x, Eigen::Index rows, Eigen::Index columns, TaskPool* pool);
  void solve_in_place(std::span<double* const> vectors, TaskPool* pool);
  void solve_by_cholmod(const double* rhs, double* x, Eigen::Index rows, Eigen::Index columns);
};

void SparseCholesky::Backend::factorise(const SparseMatrix& A, const CholeskyOptions& options) {
  SparseMatrix lower = A.triangularView<Eigen::Lower>();
  lower.makeCompressed();
  cholmod_sparse view = view_of_lower(lower);
  size = lower.rows();
  if (options.route == SolveRoute::panels) common.supernodal = CHOLMOD_SUPERNODAL;
  if (size >= kLarge) {  // CHOLMOD keeps the one with the fewest entries
    common.nmethods = 2;
    common.method[0].ordering = CHOLMOD_METIS;
    common.method[1].ordering = CHOLMOD_NESDIS;
  }
  // Several threads of BLAS gain little on supernodes of this size and lose much where other
  // processes want the processor; their number is one for the whole process, also in solves.
  choose_blas_kernels();
  openblas_set_num_threads(1);
  factor = cholmod_analyze(&view, &common);
  if (factor == nullptr) throw_out_of_memory(size);
  cholmod_factorize(&view, factor, &common);
  if (common.status < CHOLMOD_OK) throw_out_of_memory(size);
  if (factor->minor < view.nrow) {
    const int column = static_cast<const int*>(factor->Perm)[factor->minor];
    throw NumericalError("a matrix of size " + std::to_string(size) +
                         " is not positive definite (column " + std::to_string(column) +
                         "); check masses and materials of the body; over-refined beams can cause "
                         "this: use fewer elements");
  }
  entries = common.lnz;
  if (factor->is_super != 0 && options.route != SolveRoute::cholmod) lay_out(options.simd);
}

void SparseCholesky::Backend::lay_out(SimdLevel simd) {
  Supernodes source;
  source.size = static_cast<int>(size);
  source.count = static_cast<int>(factor->nsuper);
  source.permutation = static_cast<const int*>(factor->Perm);
  source.first_column = static_cast<const int*>(factor->super);
  source.rows_begin = static_cast<const int*>(factor->pi);
  source.values_begin = static_cast<const int*>(factor->px);
  source.rows = static_cast<const int*>(factor->s);
  source.values = static_cast<const double*>(factor->x);
  source.used_up = true;
  panels.emplace(source, simd);
  cholmod_free_factor(&factor, &common);
}

void SparseCholesky::Backend::solve(const double* rhs, double* x, Eigen::Index rows,
                                    Eigen::Index columns, TaskPool* pool) {
  if (rows == 0 || columns == 0) return;
  const std::scoped_lock lock(turn);
  if (panels) {
    panels->solve(rhs, x, columns, rows, workspace, pool);
  } else {
    solve_by_cholmod(rhs, x, rows, columns);
  }
}

void SparseCholesky::Backend::solve_in_place(std::span<double* const> vectors, TaskPool* pool) {
  if (size == 0 || vectors.empty()) return;
  const std::scoped_lock lock(turn);
  if (panels) {
    panels->solve_in_place(vectors, workspace, pool);
  } else {
    for (double* x : vectors) solve_by_cholmod(x, x, size, 1);
  }
}

void SparseCholesky::Backend::solve_by_cholmod(const double* rhs, double* x, Eigen::Index rows,
                                               Eigen::Index columns) {
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
    throw NumericalError("a sparse solve failed (CHOLMOD status " + std::to_string(common.status) +
                         "); is there enough memory?");
  }
  const double* values = static_cast<const double*>(solution->x);
  std::copy(values, values + rows * columns, x);
}

SparseCholesky::SparseCholesky(const SparseMatrix& A, const CholeskyOptions& options)
    : backend_(std::make_unique<Backend>()) {
  backend_->factorise(A, options);
}

SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

Eigen::Index SparseCholesky::size() const { return backend_->size; }

double SparseCholesky::num_factor_entries() const { return backend_->entries; }

SolveRoute SparseCholesky::route() const {
  return backend_->panels ? SolveRoute::panels : SolveRoute::cholmod;
}

int SparseCholesky::num_parts() const {
  return backend_->panels ? backend_->panels->num_groups() : 1;
}

bool SparseCholesky::take_panels(SimdLevel simd) {
  if (backend_->panels) return true;
  if (backend_->factor->is_super == 0) return false;
  backend_->lay_out(simd);
  return true;
}

double SparseCholesky::bytes() const {
  if (backend_->panels) return backend_->panels->bytes();
  const cholmod_factor& factor = *backend_->factor;
  if (factor.is_super != 0) return 8.0 * static_cast<double>(factor.xsize);
  return 12.0 * backend_->entries;  // a value and a row number each
}

void SparseCholesky::solve_in_place(Vector& x, TaskPool* pool) const {
  backend_->solve(x.data(), x.data(), x.size(), 1, pool);
}

void SparseCholesky::solve_in_place(Matrix& X, TaskPool* pool) const {
  backend_->solve(X.data(), X.data(), X.rows(), X.cols(), pool);
}

void SparseCholesky::solve_in_place(std::span<double* const> vectors, TaskPool* pool) const {
  backend_->solve_in_place(vectors, pool);
}

Matrix SparseCholesky::solve(const Matrix& B, TaskPool* pool) const {
  Matrix X(B.rows(), B.cols());
  backend_->solve(B.data(), X.data(), B.rows(), B.cols(), pool);
  return X;
}

}  // namespace buckens::linalg
