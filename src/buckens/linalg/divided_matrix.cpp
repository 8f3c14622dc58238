// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/divided_matrix.h"

#include <algorithm>
#include <mutex>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/linalg/grid_library.h"
#include "buckens/linalg/ranks.h"

namespace buckens::linalg {

DividedMatrix::DividedMatrix(const SparseMatrix& A, std::array<std::uint64_t, 2> content)
    : entries_(A.nonZeros()), diagonal_(A.diagonal()), content_(content) {
  const BuckensGridColumns columns{A.outerIndexPtr(), A.innerIndexPtr(), A.valuePtr()};
  std::array<char, 400> error{};
  const std::scoped_lock lock(turn_of_grid_solver());
  number_ = grid_solver().divide(static_cast<int>(A.cols()), &columns, error.data(),
                                 static_cast<int>(error.size()));
  if (number_ >= 0) return;
  throw NumericalError(
      fmt::format("a matrix of {} equations on {} processes could not be divided: {}; use more "
                  "memory, or fewer processes on a machine",
                  A.cols(), Ranks::count(), error.data()));
}

DividedMatrix::~DividedMatrix() {
  const std::scoped_lock lock(turn_of_grid_solver());
  grid_solver().forget(number_);
}

void DividedMatrix::multiply(std::span<const Product> products) {
  while (!products.empty()) {
    const auto some = products.first(std::min<std::size_t>(kBuckensMostProducts, products.size()));
    std::array<int, kBuckensMostProducts> numbers{};
    std::array<const double*, kBuckensMostProducts> x{};
    std::array<double*, kBuckensMostProducts> y{};
    for (std::size_t k = 0; k < some.size(); ++k) {
      numbers[k] = some[k].A->number_;
      x[k] = some[k].x;
      y[k] = some[k].y;
    }
    {
      const std::scoped_lock lock(turn_of_grid_solver());
      grid_solver().multiply(static_cast<int>(some.size()), numbers.data(), x.data(), y.data());
    }
    products = products.subspan(some.size());
  }
}

SparseMatrix DividedMatrix::gathered() const {
  SparseMatrix out(diagonal_.size(), diagonal_.size());
  out.resizeNonZeros(entries_);
  const std::scoped_lock lock(turn_of_grid_solver());
  grid_solver().gather(number_, out.outerIndexPtr(), out.innerIndexPtr(), out.valuePtr());
  return out;
}

}  // namespace buckens::linalg
