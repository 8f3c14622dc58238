// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/sparse_cholesky.h"

#include <mutex>
#include <new>
#include <optional>
#include <utility>

#include "buckens/base/allowed_threads.h"
#include "buckens/base/timed_phase.h"
#include "buckens/linalg/factor_cache.h"
#include "buckens/linalg/factor_work.h"
#include "buckens/linalg/finite_matrix.h"
#include "buckens/linalg/panel_factor.h"
#include "buckens/linalg/panel_file.h"
#include "buckens/linalg/supernode_tree.h"

namespace buckens::linalg {

namespace {

// Products of a factorisation, some milliseconds, to which starting threads adds next to nothing.
constexpr double kManyProducts = 2e7;
// Columns whose key takes some milliseconds.
constexpr Eigen::Index kManyColumns = 10000;
// Bytes of a factor from which it is kept in a folder: smaller ones are made in less than a tenth
// of a second.
constexpr double kWorthKeeping = 8e6;

}  // namespace

struct SparseCholesky::Backend {
  std::unique_ptr<CholmodFactor> factor;  // empty where there are panels
  std::optional<PanelFactor> panels;
  Eigen::Index size = 0;
  double entries = 0;

  std::mutex turn;  // guards what follows and `factor`
  PanelFactor::Workspace workspace;

  void factorise(const MatrixSum& A) {
    if (const SparseMatrix* alone = A.alone()) return factorise(*alone, {});
    A.form_terms();
    size = A.size();
    A.require_finite();
    find_panels(A, best_simd_level());
  }

  void factorise(const SparseMatrix& A, const CholeskyOptions& options) {
    size = A.rows();
    require_finite(A);
    if (options.route == SolveRoute::cholmod) {
      factor = CholmodFactor::make(A, {false, options.most_narrow_entries});
      entries = factor->num_entries();
    } else {
      find_panels(A, options.simd);
    }
  }

  /// Takes the panels from the folder of factors, or makes them and keeps them there.
  template <class Pattern>
  void find_panels(const Pattern& A, SimdLevel simd) {
    if (FactorCache::folder().empty()) return make_panels(A, A, simd, nullptr);
    std::optional<PanelFile> file;
    try {
      const base::TimedPhase phase("stored_factors");
      file.emplace(FactorCache::folder(), A,
                   size >= kManyColumns ? base::AllowedThreads::pool() : nullptr);
      if (take_stored(*file, simd)) return;
    } catch (const std::bad_alloc&) {
      throw too_little_memory("factorise", size, 0.0);
    }
    make_panels(A, A, simd, &*file);
  }

  /// @param pattern A itself, or one that has its pattern
  /// @param file where they are kept if they are worth it, or null
  template <class Pattern>
  void make_panels(const MatrixSum& A, const Pattern& pattern, SimdLevel simd,
                   const PanelFile* file) {
    double bytes = 0.0;
    try {
      FactorWork work(size);
      const SupernodeTree tree = order_of(pattern);
      entries = tree.num_entries;
      const base::TimedPhase phase("factor");
      TaskPool* pool = tree.num_products >= kManyProducts ? base::AllowedThreads::pool() : nullptr;
      panels.emplace(A, tree, simd, pool, [&](double needed) {
        bytes = needed;
        work.begin(bytes);
      });
      if (file != nullptr && bytes >= kWorthKeeping) {
        const base::TimedPhase storing("stored_factors");
        file->write(*panels, entries);
      }
    } catch (const std::bad_alloc&) {
      throw too_little_memory("factorise", size, bytes);
    }
  }

  template <class Pattern>
  static SupernodeTree order_of(const Pattern& pattern) {
    const base::TimedPhase phase("order");
    return find_supernode_tree(pattern);
  }

  bool take_stored(const PanelFile& file, SimdLevel simd) {
    std::optional<PanelFile::Stored> stored = file.read(simd);
    if (!stored) return false;
    panels.emplace(std::move(stored->factor));
    entries = stored->entries;
    return true;
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

SparseCholesky::SparseCholesky(const MatrixSum& A) : backend_(std::make_unique<Backend>()) {
  backend_->factorise(A);
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
  return backend_->panels ? backend_->panels->num_parts() : 1;
}

double SparseCholesky::busiest_share(int threads) const {
  return backend_->panels ? backend_->panels->busiest_share(threads) : 1.0;
}

int SparseCholesky::index_bits() const {
  return backend_->panels ? 64 : backend_->factor->index_bits();
}

bool SparseCholesky::take_panels(SimdLevel simd) {
  if (backend_->panels) return true;
  if (!backend_->factor->is_supernodal()) return false;
  Supernodes source = backend_->factor->supernodes();
  source.used_up = true;
  backend_->panels.emplace(source, simd);
  backend_->factor.reset();
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

std::shared_ptr<const Factor> make_cholesky(const MatrixSum& A) {
  return std::make_shared<const SparseCholesky>(A);
}

}  // namespace buckens::linalg
