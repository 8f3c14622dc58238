// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/block_lu.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>

namespace buckens::linalg {

namespace {

/// Blocks still to be eliminated and who is coupled with whom.
class BlockGraph {
 public:
  BlockGraph(std::size_t count, const std::vector<std::pair<int, int>>& couples) : coupled_(count) {
    for (const auto& [i, j] : couples) {
      if (i == j) continue;
      coupled_[static_cast<std::size_t>(i)].insert(j);
      coupled_[static_cast<std::size_t>(j)].insert(i);
    }
    for (std::size_t k = 0; k < count; ++k) waiting_.emplace(degree(k), static_cast<int>(k));
  }

  bool empty() const { return waiting_.empty(); }

  /// Eliminates a block of least degree, the first of them: along a chain one after the other.
  /// @return the block and what was coupled with it, which is now coupled with each other
  std::pair<int, std::vector<int>> take() {
    const int block = waiting_.begin()->second;
    waiting_.erase(waiting_.begin());
    const auto& set = coupled_[static_cast<std::size_t>(block)];
    const std::vector<int> others(set.begin(), set.end());
    for (const int i : others) {
      auto& mine = coupled_[static_cast<std::size_t>(i)];
      waiting_.erase({mine.size(), i});
      mine.erase(block);
      for (const int j : others) {
        if (j != i) mine.insert(j);
      }
      waiting_.emplace(mine.size(), i);
    }
    return {block, others};
  }

 private:
  std::size_t degree(std::size_t k) const { return coupled_[k].size(); }

  std::vector<std::set<int>> coupled_;
  std::set<std::pair<std::size_t, int>> waiting_;  // (degree, block)
};

// Blocks are stored by columns. R is their number of rows, 0 where it is known at run time only.

template <int R>
inline int rows_of(int stored) {
  return R > 0 ? R : stored;
}

/// A ← L U in place. @return the smallest share of a diagonal entry left as pivot, −1: none
template <int R>
inline double factor_diagonal(double* __restrict A, int stored, double* __restrict inverse,
                              const double* __restrict before) {
  const int n = rows_of<R>(stored);
  double ratio = 1.0;
  for (int c = 0; c < n; ++c) {
    const double pivot = A[c * n + c];
    const double share = pivot / before[c];
    if (!(share > 0.0 && pivot > 0.0)) return -1.0;
    ratio = std::min(ratio, share);
    inverse[c] = 1.0 / pivot;
    for (int i = c + 1; i < n; ++i) A[c * n + i] *= inverse[c];
    for (int j = c + 1; j < n; ++j) {
      const double above = A[j * n + c];
      for (int i = c + 1; i < n; ++i) A[j * n + i] -= A[c * n + i] * above;
    }
  }
  return ratio;
}

/// B ← L⁻¹ B, B with `columns` columns.
template <int R>
inline void solve_lower(const double* __restrict A, int stored, double* __restrict B, int columns) {
  const int n = rows_of<R>(stored);
  const int m = rows_of<R>(columns);
  for (int j = 0; j < m; ++j) {
    for (int c = 0; c < n; ++c) {
      const double value = B[j * n + c];
      for (int i = c + 1; i < n; ++i) B[j * n + i] -= A[c * n + i] * value;
    }
  }
}

/// B ← B U⁻¹, B with `rows` rows.
template <int R>
inline void solve_upper(const double* __restrict A, int stored, const double* __restrict inverse,
                        double* __restrict B, int rows) {
  const int n = rows_of<R>(stored);
  const int m = rows_of<R>(rows);
  for (int c = 0; c < n; ++c) {
    for (int k = 0; k < c; ++k) {
      const double value = A[c * n + k];
      for (int i = 0; i < m; ++i) B[c * m + i] -= B[k * m + i] * value;
    }
    for (int i = 0; i < m; ++i) B[c * m + i] *= inverse[c];
  }
}

/// C ← C − L U with L rows×n, U n×columns.
template <int R>
inline void subtract_product(const double* __restrict L, const double* __restrict U,
                             double* __restrict C, int stored, int rows, int columns) {
  const int n = rows_of<R>(stored);
  const int m = rows_of<R>(rows);
  const int last = rows_of<R>(columns);
  for (int j = 0; j < last; ++j) {
    for (int k = 0; k < n; ++k) {
      const double value = U[j * n + k];
      for (int i = 0; i < m; ++i) C[j * m + i] -= L[k * m + i] * value;
    }
  }
}

/// x ← L⁻¹ x.
template <int R>
inline void substitute_forward(const double* __restrict A, int stored, double* __restrict x) {
  const int n = rows_of<R>(stored);
  for (int c = 0; c < n; ++c) {
    for (int i = c + 1; i < n; ++i) x[i] -= A[c * n + i] * x[c];
  }
}

/// x ← U⁻¹ x.
template <int R>
inline void substitute_back(const double* __restrict A, int stored, const double* inverse,
                            double* __restrict x) {
  const int n = rows_of<R>(stored);
  for (int c = n - 1; c >= 0; --c) {
    x[c] *= inverse[c];
    for (int i = 0; i < c; ++i) x[i] -= A[c * n + i] * x[c];
  }
}

/// y ← y − A x, A rows×columns.
template <int R>
inline void subtract_times(const double* __restrict A, int rows, int columns,
                           const double* __restrict x, double* __restrict y) {
  const int m = rows_of<R>(rows);
  const int n = rows_of<R>(columns);
  for (int k = 0; k < n; ++k) {
    const double value = x[k];
    for (int i = 0; i < m; ++i) y[i] -= A[k * m + i] * value;
  }
}

}  // namespace

BlockLu::BlockLu(std::vector<int> sizes, const std::vector<std::pair<int, int>>& couples)
    : sizes_(std::move(sizes)), first_row_(1, 0), by_row_(sizes_.size()) {
  for (const int size : sizes_) first_row_.push_back(first_row_.back() + size);
  order(couples);
  lay_out();
  clear();
}

void BlockLu::order(const std::vector<std::pair<int, int>>& couples) {
  BlockGraph graph(sizes_.size(), couples);
  const auto add = [&](int i, int j) {
    by_row_[static_cast<std::size_t>(i)].emplace_back(j, static_cast<int>(places_.size()));
    places_.push_back({i, j, 0, 0});
  };
  while (!graph.empty()) {
    auto [block, others] = graph.take();
    add(block, block);
    for (const int other : others) {
      add(other, block);
      add(block, other);
    }
    sequence_.push_back(block);
    coupled_.push_back(std::move(others));
  }
  for (auto& row : by_row_) std::sort(row.begin(), row.end());
}

int BlockLu::place(int i, int j) const {
  const auto& row = by_row_[static_cast<std::size_t>(i)];
  return std::lower_bound(row.begin(), row.end(), std::pair<int, int>{j, 0})->second;
}

void BlockLu::lay_out() {
  const auto rows = [&](int block) { return sizes_[static_cast<std::size_t>(block)]; };
  const int largest = sizes_.empty() ? 0 : *std::max_element(sizes_.begin(), sizes_.end());
  double least = 0;
  for (const Place& place : places_) least += rows(place.row) * rows(place.column);
  const double padded = static_cast<double>(places_.size()) * largest * largest;
  uniform_ = padded <= 2.0 * least ? largest : 0;
  const auto stored = [&](int block) { return uniform_ > 0 ? uniform_ : rows(block); };

  std::size_t next = 0;
  for (Place& place : places_) {
    place.first = next;
    place.stride = stored(place.row);
    next += static_cast<std::size_t>(place.stride * stored(place.column));
  }
  values_.resize(next);
  first_stored_.resize(sizes_.size());
  std::size_t row = 0;
  for (const int block : sequence_) {
    first_stored_[static_cast<std::size_t>(block)] = row;
    row += static_cast<std::size_t>(stored(block));
  }
  inverse_.resize(row);
  x_.assign(row, 0.0);

  const auto first_of = [&](int i, int j) {
    return places_[static_cast<std::size_t>(place(i, j))].first;
  };
  for (std::size_t k = 0; k < sequence_.size(); ++k) {
    const int block = sequence_[k];
    const std::size_t first = neighbours_.size();
    for (const int other : coupled_[k]) {
      neighbours_.push_back({stored(other), first_stored_[static_cast<std::size_t>(other)],
                             first_of(other, block), first_of(block, other)});
    }
    pivots_.push_back({block, stored(block), first_stored_[static_cast<std::size_t>(block)],
                       first_of(block, block), first, neighbours_.size()});
    for (const int i : coupled_[k]) {
      for (const int j : coupled_[k]) updates_.push_back(first_of(i, j));
    }
  }
  coupled_.clear();
}

void BlockLu::clear() {
  std::fill(values_.begin(), values_.end(), 0.0);
  for (const Pivot& pivot : pivots_) {
    for (int k = sizes_[static_cast<std::size_t>(pivot.block)]; k < pivot.stored; ++k) {
      values_[pivot.diagonal + static_cast<std::size_t>(k * pivot.stored + k)] = 1.0;
    }
  }
}

double& BlockLu::diagonal(int row) {
  const auto next = std::upper_bound(first_row_.begin(), first_row_.end(), row);
  const int block = static_cast<int>(next - first_row_.begin()) - 1;
  const Place& at = places_[static_cast<std::size_t>(place(block, block))];
  const int k = row - first_row_[static_cast<std::size_t>(block)];
  return values_[at.first + static_cast<std::size_t>(k * at.stride + k)];
}

template <int R>
bool BlockLu::eliminate() {
  // What the diagonal held is kept where a solve works.
  for (const Pivot& pivot : pivots_) {
    const int n = rows_of<R>(pivot.stored);
    for (int k = 0; k < n; ++k) {
      x_[pivot.first_stored + static_cast<std::size_t>(k)] =
          values_[pivot.diagonal + static_cast<std::size_t>(k * n + k)];
    }
  }
  double ratio = 1.0;
  const std::size_t* update = updates_.data();
  double* const values = values_.data();
  for (const Pivot& pivot : pivots_) {
    double* const A = values + pivot.diagonal;
    double* const inverse = &inverse_[pivot.first_stored];
    const double share = factor_diagonal<R>(A, pivot.stored, inverse, &x_[pivot.first_stored]);
    if (share < 0.0) return false;
    ratio = std::min(ratio, share);
    for (std::size_t i = pivot.first_neighbour; i < pivot.end_neighbour; ++i) {
      const Neighbour& other = neighbours_[i];
      solve_lower<R>(A, pivot.stored, values + other.upper, other.stored);
      solve_upper<R>(A, pivot.stored, inverse, values + other.lower, other.stored);
    }
    for (std::size_t i = pivot.first_neighbour; i < pivot.end_neighbour; ++i) {
      for (std::size_t j = pivot.first_neighbour; j < pivot.end_neighbour; ++j, ++update) {
        subtract_product<R>(values + neighbours_[i].lower, values + neighbours_[j].upper,
                            values + *update, pivot.stored, neighbours_[i].stored,
                            neighbours_[j].stored);
      }
    }
  }
  pivot_ratio_ = ratio;
  return true;
}

template <int R>
void BlockLu::substitute() const {
  const double* const values = values_.data();
  double* const x = x_.data();
  for (const Pivot& pivot : pivots_) {
    double* const mine = x + pivot.first_stored;
    substitute_forward<R>(values + pivot.diagonal, pivot.stored, mine);
    for (std::size_t i = pivot.first_neighbour; i < pivot.end_neighbour; ++i) {
      const Neighbour& other = neighbours_[i];
      subtract_times<R>(values + other.lower, other.stored, pivot.stored, mine,
                        x + other.first_stored);
    }
  }
  for (std::size_t k = pivots_.size(); k-- > 0;) {
    const Pivot& pivot = pivots_[k];
    double* const mine = x + pivot.first_stored;
    for (std::size_t i = pivot.first_neighbour; i < pivot.end_neighbour; ++i) {
      const Neighbour& other = neighbours_[i];
      subtract_times<R>(values + other.upper, pivot.stored, other.stored, x + other.first_stored,
                        mine);
    }
    substitute_back<R>(values + pivot.diagonal, pivot.stored, &inverse_[pivot.first_stored], mine);
  }
}

bool BlockLu::factorise() {
  pivot_ratio_ = 0;
  switch (uniform_) {
    case 1:
      return eliminate<1>();
    case 2:
      return eliminate<2>();
    case 3:
      return eliminate<3>();
    case 5:
      return eliminate<5>();
    case 6:
      return eliminate<6>();
    default:
      return eliminate<0>();
  }
}

void BlockLu::solve_in_place(Vector& x) const {
  const auto for_rows = [&](auto&& f) {
    for (std::size_t k = 0; k < sizes_.size(); ++k) {
      for (int i = 0; i < sizes_[k]; ++i) {
        f(x[first_row_[k] + i], x_[first_stored_[k] + static_cast<std::size_t>(i)]);
      }
    }
  };
  std::fill(x_.begin(), x_.end(), 0.0);
  for_rows([](double from, double& to) { to = from; });
  switch (uniform_) {
    case 1:
      substitute<1>();
      break;
    case 2:
      substitute<2>();
      break;
    case 3:
      substitute<3>();
      break;
    case 5:
      substitute<5>();
      break;
    case 6:
      substitute<6>();
      break;
    default:
      substitute<0>();
  }
  for_rows([](double& to, double from) { to = from; });
}

}  // namespace buckens::linalg
