// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/row_order.h"

#include <algorithm>
#include <numeric>

namespace buckens::linalg {

RowOrder::RowOrder(const std::vector<int>& part, int parts)
    : rows_(part.size()),
      variables_(part.size()),
      first_rows_(static_cast<std::size_t>(parts) + 1, 0) {
  for (const int k : part) ++first_rows_[static_cast<std::size_t>(k) + 1];
  std::partial_sum(first_rows_.begin(), first_rows_.end(), first_rows_.begin());
  std::vector<int> next(first_rows_.begin(), first_rows_.end() - 1);
  for (std::size_t variable = 0; variable < part.size(); ++variable) {
    const int row = next[static_cast<std::size_t>(part[variable])]++;
    rows_[variable] = row;
    variables_[static_cast<std::size_t>(row)] = static_cast<int>(variable);
  }
}

bool is_same_order(const SharedRowOrder& a, const SharedRowOrder& b) {
  if (a == b) return true;
  return a && b && a->first_rows() == b->first_rows() && a->variables() == b->variables();
}

BuckensGridRows rows_for_plugin(const SharedRowOrder& order) {
  if (!order) return {nullptr, nullptr};
  return {order->first_rows().data(), order->variables().data()};
}

SparseMatrix renumbered_symmetric(const SparseMatrix& A, const std::vector<int>& numbers) {
  // Transposed: then rows of a column come in their order.
  const auto number = [&numbers](Eigen::Index k) { return numbers[static_cast<std::size_t>(k)]; };
  SparseMatrix out(A.cols(), A.rows());
  out.resizeNonZeros(A.nonZeros());
  std::vector<int> next(numbers.size() + 1, 0);  // places behind what columns have so far
  for (int column = 0; column < A.outerSize(); ++column) {
    for (SparseMatrix::InnerIterator it(A, column); it; ++it) {
      ++next[static_cast<std::size_t>(number(it.row())) + 1];
    }
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::copy(next.begin(), next.end(), out.outerIndexPtr());
  std::vector<int> old(numbers.size());
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    old[static_cast<std::size_t>(numbers[k])] = static_cast<int>(k);
  }
  for (int row = 0; row < A.outerSize(); ++row) {
    for (SparseMatrix::InnerIterator it(A, old[static_cast<std::size_t>(row)]); it; ++it) {
      const int place = next[static_cast<std::size_t>(number(it.row()))]++;
      out.innerIndexPtr()[place] = row;
      out.valuePtr()[place] = it.value();
    }
  }
  return out;
}

SparseMatrix renumbered(const SparseMatrix& A, const std::vector<int>& numbers) {
  return renumbered_symmetric(A, numbers).transpose();
}

}  // namespace buckens::linalg
