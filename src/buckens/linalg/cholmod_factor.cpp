// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/cholmod_factor.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <cholmod.h>
#include <fmt/format.h>

#include "buckens/linalg/factor_work.h"
#include "buckens/linalg/single_thread.h"

namespace buckens::linalg {

namespace {

// Below this size orderings differ too little to try several.
constexpr Eigen::Index kLarge = 3000;

// The constants of both are functions. NOLINTBEGIN(readability-identifier-naming)

/// CHOLMOD with 32-bit indices.
struct Narrow {
  using Index = int;
  static constexpr int kIndexType = CHOLMOD_INT;
  static constexpr auto start = cholmod_start;
  static constexpr auto finish = cholmod_finish;
  static constexpr auto analyze = cholmod_analyze;
  static constexpr auto factorize = cholmod_factorize;
  static constexpr auto solve = cholmod_solve2;
  static constexpr auto free_dense = cholmod_free_dense;
  static constexpr auto free_factor = cholmod_free_factor;
};

/// CHOLMOD with 64-bit indices.
struct Wide {
  using Index = SuiteSparse_long;
  static constexpr int kIndexType = CHOLMOD_LONG;
  static constexpr auto start = cholmod_l_start;
  static constexpr auto finish = cholmod_l_finish;
  static constexpr auto analyze = cholmod_l_analyze;
  static constexpr auto factorize = cholmod_l_factorize;
  static constexpr auto solve = cholmod_l_solve2;
  static constexpr auto free_dense = cholmod_l_free_dense;
  static constexpr auto free_factor = cholmod_l_free_factor;
};

// NOLINTEND(readability-identifier-naming)

/// Thrown if indices are too narrow.
struct TooLarge {};

/// The lower triangle of a matrix as CHOLMOD reads it.
template <class Api>
class LowerTriangle {
 public:
  using Index = typename Api::Index;

  explicit LowerTriangle(const SparseMatrix& A) : lower_(A.triangularView<Eigen::Lower>()) {
    lower_.makeCompressed();
    view_.nrow = static_cast<std::size_t>(lower_.rows());
    view_.ncol = static_cast<std::size_t>(lower_.cols());
    view_.nzmax = static_cast<std::size_t>(lower_.nonZeros());
    view_.p = indices(lower_.outerIndexPtr(), lower_.cols() + 1, starts_);
    view_.i = indices(lower_.innerIndexPtr(), lower_.nonZeros(), rows_);
    view_.x = lower_.valuePtr();
    view_.stype = -1;
    view_.itype = Api::kIndexType;
    view_.xtype = CHOLMOD_REAL;
    view_.dtype = CHOLMOD_DOUBLE;
    view_.sorted = 1;
    view_.packed = 1;
  }
  LowerTriangle(const LowerTriangle&) = delete;
  LowerTriangle& operator=(const LowerTriangle&) = delete;

  cholmod_sparse* view() { return &view_; }

 private:
  static Index* indices(int* from, Eigen::Index count, std::vector<Index>& copy) {
    if constexpr (std::is_same_v<Index, int>) {
      return from;
    } else {
      copy.assign(from, from + count);
      return copy.data();
    }
  }

  SparseMatrix lower_;
  std::vector<Index> starts_, rows_;
  cholmod_sparse view_{};
};

/// Numbers of a factor in another width, if that is needed. @param copy keeps them
template <class To, class From>
const To* converted(const void* from, std::size_t count, std::vector<To>& copy) {
  const From* values = static_cast<const From*>(from);
  if constexpr (std::is_same_v<To, From>) {
    return values;
  } else {
    copy.assign(values, values + count);
    return copy.data();
  }
}

template <class Api>
class FactorOf final : public CholmodFactor {
 public:
  using Index = typename Api::Index;

  FactorOf(const SparseMatrix& A, const Options& options) : size_(A.rows()) {
    Api::start(&common_);
    common_.print = 0;
    common_.final_ll = 1;  // L Lᵀ also for small matrices: L D Lᵀ would accept indefinite ones
    if (options.supernodal) common_.supernodal = CHOLMOD_SUPERNODAL;
    if (size_ >= kLarge) {  // CHOLMOD keeps the one with the fewest entries
      common_.nmethods = 2;
      common_.method[0].ordering = CHOLMOD_METIS;
      common_.method[1].ordering = CHOLMOD_NESDIS;
    }
    try {
      factorise(A, options);
    } catch (...) {
      release();
      throw;
    }
  }
  ~FactorOf() override { release(); }
  FactorOf(const FactorOf&) = delete;
  FactorOf& operator=(const FactorOf&) = delete;

  void solve(const double* b, double* x, Eigen::Index rows, Eigen::Index columns) override {
    cholmod_dense side{};
    side.nrow = static_cast<std::size_t>(rows);
    side.ncol = static_cast<std::size_t>(columns);
    side.nzmax = side.nrow * side.ncol;
    side.d = side.nrow;
    side.x = const_cast<double*>(b);  // CHOLMOD reads it only
    side.xtype = CHOLMOD_REAL;
    side.dtype = CHOLMOD_DOUBLE;
    const SingleThread alone;
    if (Api::solve(CHOLMOD_A, factor_, &side, nullptr, &solution_, nullptr, &work_y_, &work_e_,
                   &common_) == 0) {
      fail("solve for", 8.0 * 3.0 * static_cast<double>(rows) * static_cast<double>(columns));
    }
    const double* values = static_cast<const double*>(solution_->x);
    std::copy(values, values + rows * columns, x);
  }

  bool is_supernodal() const override { return factor_->is_super != 0; }

  Supernodes supernodes() override {
    const std::size_t count = factor_->nsuper;
    Supernodes out;
    out.size = static_cast<int>(size_);
    out.count = static_cast<int>(count);
    out.permutation = converted<int, Index>(factor_->Perm, factor_->n, permutation_);
    out.first_column = converted<int, Index>(factor_->super, count + 1, first_column_);
    out.rows_begin = converted<std::int64_t, Index>(factor_->pi, count + 1, rows_begin_);
    out.values_begin = converted<std::int64_t, Index>(factor_->px, count + 1, values_begin_);
    out.rows = converted<int, Index>(factor_->s, factor_->ssize, rows_);
    out.values = static_cast<const double*>(factor_->x);
    return out;
  }

  double num_entries() const override { return common_.lnz; }

  double bytes() const override {
    if (is_supernodal()) return 8.0 * static_cast<double>(factor_->xsize);
    return (8.0 + sizeof(Index)) * common_.lnz;  // a value and a row number each
  }

  int index_bits() const override { return 8 * static_cast<int>(sizeof(Index)); }

 private:
  void factorise(const SparseMatrix& A, const Options& options) {
    const SingleThread alone;
    FactorWork work(size_);
    LowerTriangle<Api> lower(A);
    factor_ = Api::analyze(lower.view(), &common_);
    if (factor_ == nullptr) fail("analyse", 0.0);
    constexpr bool is_narrow = std::is_same_v<Index, int>;
    if (is_narrow && reach() > options.most_narrow) throw TooLarge{};
    work.begin(predicted_bytes());
    Api::factorize(lower.view(), factor_, &common_);
    if (common_.status < CHOLMOD_OK) fail("factorise", predicted_bytes());
    if (factor_->minor < static_cast<std::size_t>(size_)) {
      throw IndefiniteMatrix(size_, static_cast<const Index*>(factor_->Perm)[factor_->minor]);
    }
  }

  /// Largest number that an index of the factor has to hold.
  double reach() const {
    return std::max(
        {common_.lnz, static_cast<double>(factor_->xsize), static_cast<double>(factor_->ssize)});
  }

  double predicted_bytes() const {
    return factor_->is_super != 0 ? 8.0 * static_cast<double>(factor_->xsize)
                                  : (8.0 + sizeof(Index)) * common_.lnz;
  }

  /// Reports a failure of CHOLMOD. @param bytes that it needed, as far as known
  [[noreturn]] void fail(const char* task, double bytes) const {
    if (common_.status == CHOLMOD_TOO_LARGE) throw TooLarge{};
    if (common_.status == CHOLMOD_OUT_OF_MEMORY) throw too_little_memory(task, size_, bytes);
    throw NumericalError(
        fmt::format("CHOLMOD could not {} a matrix of size {} (status {}); please report this with "
                    "the model",
                    task, size_, common_.status));
  }

  void release() {
    Api::free_dense(&solution_, &common_);
    Api::free_dense(&work_y_, &common_);
    Api::free_dense(&work_e_, &common_);
    Api::free_factor(&factor_, &common_);
    Api::finish(&common_);
  }

  Eigen::Index size_;
  cholmod_common common_{};
  cholmod_factor* factor_ = nullptr;
  // Workspace that CHOLMOD keeps between solves.
  cholmod_dense* solution_ = nullptr;
  cholmod_dense* work_y_ = nullptr;
  cholmod_dense* work_e_ = nullptr;
  std::vector<int> permutation_, first_column_, rows_;
  std::vector<std::int64_t> rows_begin_, values_begin_;
};

}  // namespace

std::unique_ptr<CholmodFactor> CholmodFactor::make(const SparseMatrix& A, const Options& options) {
  try {
    return std::make_unique<FactorOf<Narrow>>(A, options);
  } catch (const TooLarge&) {
    try {
      return std::make_unique<FactorOf<Wide>>(A, options);
    } catch (const TooLarge&) {
      throw NumericalError(fmt::format(
          "the factor of a matrix of size {} is too large for 64-bit indices; use a coarser mesh",
          A.rows()));
    }
  }
}

}  // namespace buckens::linalg
