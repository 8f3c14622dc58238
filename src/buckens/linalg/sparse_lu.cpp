// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/sparse_lu.h"

#include <klu.h>

#include "buckens/base/errors.h"

namespace buckens::linalg {

namespace {
// Below this growth the old pivots lose about eight digits: pivot again.
constexpr double kSmallestGrowth = 1e-8;
constexpr double kSingular = 1e-14;
}  // namespace

struct SparseLu::Backend {
  klu_common common{};
  klu_symbolic* symbolic = nullptr;
  klu_numeric* numeric = nullptr;
  std::vector<double> pivoted;  // values of the matrix that numeric was pivoted for

  Backend() { klu_defaults(&common); }
  ~Backend() {
    klu_free_numeric(&numeric, &common);
    klu_free_symbolic(&symbolic, &common);
  }
  Backend(const Backend&) = delete;
  Backend& operator=(const Backend&) = delete;
};

SparseLu::SparseLu(const SparseMatrix& pattern) : backend_(std::make_unique<Backend>()) {
  if (pattern.rows() == 0) return;
  backend_->symbolic =
      klu_analyze(static_cast<int>(pattern.rows()), const_cast<int*>(pattern.outerIndexPtr()),
                  const_cast<int*>(pattern.innerIndexPtr()), &backend_->common);
  if (backend_->symbolic == nullptr) {
    throw NumericalError("the joint equations are structurally singular; remove a joint");
  }
}

SparseLu::~SparseLu() = default;
SparseLu::SparseLu(SparseLu&&) noexcept = default;
SparseLu& SparseLu::operator=(SparseLu&&) noexcept = default;

bool SparseLu::factorise(const SparseMatrix& A) {
  if (backend_->symbolic == nullptr) return true;
  int* outer = const_cast<int*>(A.outerIndexPtr());
  int* inner = const_cast<int*>(A.innerIndexPtr());
  double* values = const_cast<double*>(A.valuePtr());
  klu_common* common = &backend_->common;
  if (backend_->numeric != nullptr) {
    const bool is_good =
        klu_refactor(outer, inner, values, backend_->symbolic, backend_->numeric, common) != 0 &&
        klu_rgrowth(outer, inner, values, backend_->symbolic, backend_->numeric, common) != 0 &&
        common->rgrowth > kSmallestGrowth && pivot_ratio() > kSingular;
    if (is_good) return true;
    klu_free_numeric(&backend_->numeric, common);
  }
  backend_->numeric = klu_factor(outer, inner, values, backend_->symbolic, common);
  backend_->pivoted.assign(values, values + A.nonZeros());
  return backend_->numeric != nullptr && pivot_ratio() > kSingular;
}

const std::vector<double>& SparseLu::pivoted_values() const { return backend_->pivoted; }

double SparseLu::pivot_ratio() const {
  if (backend_->symbolic == nullptr) return 1.0;
  if (backend_->numeric == nullptr) return 0.0;
  klu_rcond(backend_->symbolic, backend_->numeric, &backend_->common);
  return backend_->common.rcond;
}

void SparseLu::solve_in_place(Vector& x) const {
  if (backend_->symbolic == nullptr) return;
  klu_solve(backend_->symbolic, backend_->numeric, static_cast<int>(x.size()), 1, x.data(),
            &backend_->common);
}

void SparseLu::solve_in_place(Matrix& X) const {
  if (backend_->symbolic == nullptr) return;
  klu_solve(backend_->symbolic, backend_->numeric, static_cast<int>(X.rows()),
            static_cast<int>(X.cols()), X.data(), &backend_->common);
}

double SparseLu::predicted_entries() const {
  return backend_->symbolic == nullptr ? 0.0 : backend_->symbolic->lnz + backend_->symbolic->unz;
}

double SparseLu::num_factor_entries() const {
  if (backend_->numeric == nullptr) return 0.0;
  return static_cast<double>(backend_->numeric->lnz) + static_cast<double>(backend_->numeric->unz);
}

}  // namespace buckens::linalg
