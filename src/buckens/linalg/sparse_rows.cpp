// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/sparse_rows.h"

#include <array>
#include <mutex>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/linalg/grid_library.h"
#include "buckens/linalg/ranks.h"

namespace buckens::linalg {

/// Rows of the plug-in, divided among the processes.
class SparseRows::Elsewhere {
 public:
  explicit Elsewhere(const RowMajor& A) {
    const BuckensGridColumns rows{A.outerIndexPtr(), A.innerIndexPtr(), A.valuePtr()};
    std::array<char, 400> error{};
    const std::scoped_lock lock(turn_of_grid_solver());
    number_ = grid_solver().divide_rows(static_cast<int>(A.rows()), static_cast<int>(A.cols()),
                                        &rows, error.data(), static_cast<int>(error.size()));
    if (number_ >= 0) return;
    throw NumericalError(
        fmt::format("a matrix of {} rows and {} columns could not be divided among {} processes: "
                    "{}; use more memory, or fewer processes on a machine",
                    A.rows(), A.cols(), Ranks::count(), error.data()));
  }
  ~Elsewhere() {
    const std::scoped_lock lock(turn_of_grid_solver());
    grid_solver().forget(number_);
  }
  Elsewhere(const Elsewhere&) = delete;
  Elsewhere& operator=(const Elsewhere&) = delete;

  void multiply(const double* x, double* y) const {
    const std::scoped_lock lock(turn_of_grid_solver());
    grid_solver().multiply(1, &number_, &x, &y);
  }

 private:
  int number_ = -1;
};

SparseRows::SparseRows(RowMajor&& A) : rows_(A.rows()) {
  if (is_shared_work(A.cols())) {
    elsewhere_ = std::make_shared<const Elsewhere>(A);
    RowMajor().swap(A);
  } else {
    here_.swap(A);
  }
}

Vector SparseRows::operator*(const Vector& x) const {
  if (!elsewhere_) return here_ * x;
  Vector y(rows_);
  elsewhere_->multiply(x.data(), y.data());
  return y;
}

}  // namespace buckens::linalg
