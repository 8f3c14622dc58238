// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/sparse_rows.h"

#include <array>
#include <cmath>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/linalg/grid_library.h"
#include "buckens/linalg/ranks.h"
#include "buckens/linalg/row_order.h"
#include "buckens/linalg/row_program.h"

namespace buckens::linalg {

/// Rows of the plug-in, divided among the processes.
class SparseRows::Elsewhere {
 public:
  explicit Elsewhere(const RowMajor& A) {
    const BuckensGridColumns rows{A.outerIndexPtr(), A.innerIndexPtr(), A.valuePtr()};
    ask({A.rows(), A.cols(), "divided among"}, [&](char* error, int error_size) {
      return grid_solver().divide_rows(static_cast<int>(A.rows()), static_cast<int>(A.cols()),
                                       &rows, error, error_size);
    });
  }
  Elsewhere(Eigen::Index rows, Eigen::Index columns, SharedRowOrder order,
            const DescribeColumns& describe)
      : order_(std::move(order)) {
    ColumnDescriptions own(describe);
    const BuckensGridDescription of = own.for_plugin();
    const BuckensGridRows runs = rows_for_plugin(order_);
    ask({rows, columns, "made by"}, [&](char* error, int error_size) {
      return grid_solver().make_rows(static_cast<int>(rows), static_cast<int>(columns), &runs, &of,
                                     error, error_size);
    });
  }
  ~Elsewhere() {
    const std::scoped_lock lock(turn_of_grid_solver());
    grid_solver().forget(number_);
  }
  Elsewhere(const Elsewhere&) = delete;
  Elsewhere& operator=(const Elsewhere&) = delete;

  void multiply(const double* x, double* y) const {
    const std::scoped_lock lock(turn_of_grid_solver());
    fill_by_rows(order_, y,
                 [&](double* of_rows) { grid_solver().multiply(1, &number_, &x, &of_rows); });
  }

  /// Whether processes have whole runs of rows that belong together.
  bool has_runs() const { return order_ != nullptr || Ranks::count() == 2; }
  std::pair<int, bool> number_for(int space) const {
    return {number_, std::exchange(space_, space) != space};
  }

 private:
  struct Wish {
    Eigen::Index rows, columns;
    const char* verb;
  };

  /// @param call (error, its size) → number
  template <class Call>
  void ask(const Wish& wish, Call&& call) {
    std::array<char, 400> error{};
    const std::scoped_lock lock(turn_of_grid_solver());
    number_ = call(error.data(), static_cast<int>(error.size()));
    if (number_ >= 0) return;
    throw NumericalError(
        fmt::format("a matrix of {} rows and {} columns could not be {} {} processes: {}; use more "
                    "memory, or fewer processes on a machine",
                    wish.rows, wish.columns, wish.verb, Ranks::count(), error.data()));
  }

  SharedRowOrder order_;
  int number_ = -1;
  mutable int space_ = -1;  // of the body whose vectors it multiplied last
};

SparseRows::SparseRows(RowMajor&& A) : rows_(A.rows()) {
  if (is_shared_work(A.cols())) {
    elsewhere_ = std::make_shared<const Elsewhere>(A);
    RowMajor().swap(A);
  } else {
    here_.swap(A);
  }
}

SparseRows::SparseRows(Eigen::Index rows, Eigen::Index columns, const SharedRowOrder& order,
                       const DescribeColumns& describe)
    : rows_(rows), elsewhere_(std::make_shared<const Elsewhere>(rows, columns, order, describe)) {}

Vector SparseRows::multiplied(const Vector& x, TaskPool* pool) const {
  Vector y(rows_);
  if (elsewhere_) {
    elsewhere_->multiply(x.data(), y.data());
    return y;
  }
  run_ranges(pool, static_cast<int>(rows_), [&](int begin, int end) {
    y.segment(begin, end - begin).noalias() = here_.middleRows(begin, end - begin) * x;
  });
  return y;
}

std::optional<double> SparseRows::largest_norm(const NodalVector& x, const Matrix& F) const {
  const std::shared_ptr<DividedVectors> of = x.others();
  if (!elsewhere_ || !of || !elsewhere_->has_runs()) return std::nullopt;
  RowProgram program(*of);
  const RowProgram::Sums norms = program.largest_norm(*this, x.divided(of), F);
  program.run();
  return std::sqrt(program.most(norms, 0));
}

std::pair<int, bool> SparseRows::number_for(int space) const {
  return elsewhere_->number_for(space);
}

}  // namespace buckens::linalg
