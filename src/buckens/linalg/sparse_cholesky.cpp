// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/sparse_cholesky.h"

#include <mutex>
#include <optional>
#include <utility>

#include "buckens/linalg/panel_factor.h"

namespace buckens::linalg {

struct SparseCholesky::Backend {
  std::unique_ptr<CholmodFactor> factor;  // empty where there are panels
  std::optional<PanelFactor> panels;
  Eigen::Index size = 0;
  double entries = 0;
  int index_bits = 0;

  std::mutex turn;  // guards what follows and `factor`
  PanelFactor::Workspace workspace;

  void factorise(const SparseMatrix& A, const CholeskyOptions& options) {
    size = A.rows();
    factor =
        CholmodFactor::make(A, {options.route == SolveRoute::panels, options.most_narrow_entries});
    entries = factor->num_entries();
    index_bits = factor->index_bits();
    if (factor->is_supernodal() && options.route != SolveRoute::cholmod) lay_out(options.simd);
  }

  void lay_out(SimdLevel simd) {
    Supernodes source = factor->supernodes();
    source.used_up = true;
    panels.emplace(source, simd);
    factor.reset();
  }

  void solve(const double* rhs, double* x, Eigen::Index columns, TaskPool* pool) {
    if (size == 0 || columns == 0) return;
    const std::scoped_lock lock(turn);
    if (panels) {
      panels->solve(rhs, x, columns, size, workspace, pool);
    } else {
      factor->solve(rhs, x, size, columns);
    }
  }

  void solve_in_place(std::span<double* const> vectors, TaskPool* pool) {
    if (size == 0 || vectors.empty()) return;
    const std::scoped_lock lock(turn);
    if (panels) {
      panels->solve_in_place(vectors, workspace, pool);
    } else {
      for (double* x : vectors) factor->solve(x, x, size, 1);
    }
  }
};

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

int SparseCholesky::index_bits() const { return backend_->index_bits; }

bool SparseCholesky::take_panels(SimdLevel simd) {
  if (backend_->panels) return true;
  if (!backend_->factor->is_supernodal()) return false;
  backend_->lay_out(simd);
  return true;
}

double SparseCholesky::bytes() const {
  return backend_->panels ? backend_->panels->bytes() : backend_->factor->bytes();
}

void SparseCholesky::solve(const double* B, double* X, Eigen::Index columns, TaskPool* pool) const {
  backend_->solve(B, X, columns, pool);
}

void SparseCholesky::solve_in_place(std::span<double* const> vectors, TaskPool* pool) const {
  backend_->solve_in_place(vectors, pool);
}

std::shared_ptr<const Factor> make_cholesky(const SparseMatrix& A) {
  return std::make_shared<const SparseCholesky>(A);
}

}  // namespace buckens::linalg
