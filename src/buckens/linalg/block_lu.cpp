// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/block_lu.h"

#include <algorithm>
#include <numeric>

#include "buckens/linalg/least_degree.h"

namespace buckens::linalg {

namespace {

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

BlockLu::BlockLu(std::vector<int> sizes, const std::vector<std::pair<int, int>>& couples,
                 std::vector<int> rows)
    : sizes_(std::move(sizes)), rows_(std::move(rows)), by_row_(sizes_.size()) {
  if (rows_.empty()) {
    rows_.resize(static_cast<std::size_t>(std::accumulate(sizes_.begin(), sizes_.end(), 0)));
    std::iota(rows_.begin(), rows_.end(), 0);
  }
  order(couples);
  lay_out();
  clear();
}

void BlockLu::order(const std::vector<std::pair<int, int>>& couples) {
  const auto add = [&](int i, int j) {
    by_row_[static_cast<std::size_t>(i)].emplace_back(j, static_cast<int>(places_.size()));
    places_.push_back({i, j, 0, 0});
  };
  for (EliminationStep& step : eliminate_by_least_degree(sizes_.size(), couples)) {
    add(step.vertex, step.vertex);
    for (const int other : step.coupled) {
      add(other, step.vertex);
      add(step.vertex, other);
    }
    sequence_.push_back(step.vertex);
    coupled_.push_back(std::move(step.coupled));
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
  std::vector<int> turn(sizes_.size());
  for (std::size_t k = 0; k < sequence_.size(); ++k) {
    turn[static_cast<std::size_t>(sequence_[k])] = static_cast<int>(k);
  }
  for (std::size_t k = 0; k < sequence_.size(); ++k) {
    const int block = sequence_[k];
    const std::size_t first = neighbours_.size();
    for (const int other : coupled_[k]) {
      const auto o = static_cast<std::size_t>(other);
      neighbours_.push_back({stored(other), turn[o], first_stored_[o], first_of(other, block),
                             first_of(block, other), false});
    }
    std::sort(neighbours_.begin() + static_cast<std::ptrdiff_t>(first), neighbours_.end(),
              [](const Neighbour& a, const Neighbour& b) { return a.turn < b.turn; });
    pivots_.push_back({block, stored(block), first_stored_[static_cast<std::size_t>(block)],
                       first_of(block, block), first, neighbours_.size(), false});
  }
  coupled_.clear();
  place_rows();
}

void BlockLu::place_rows() {
  diagonal_.resize(rows_.size());
  stored_place_.clear();
  for (std::size_t block = 0; block < sizes_.size(); ++block) {
    const Place& at =
        places_[static_cast<std::size_t>(place(static_cast<int>(block), static_cast<int>(block)))];
    for (int k = 0; k < sizes_[block]; ++k) {
      const auto row = static_cast<std::size_t>(rows_[stored_place_.size()]);
      diagonal_[row] = at.first + static_cast<std::size_t>(k * at.stride + k);
      stored_place_.push_back(first_stored_[block] + static_cast<std::size_t>(k));
    }
  }
}

std::size_t BlockLu::size_of(const Place& place) const {
  const int columns = uniform_ > 0 ? uniform_ : sizes_[static_cast<std::size_t>(place.column)];
  return static_cast<std::size_t>(place.stride * columns);
}

template <class F>
void BlockLu::for_coupled(F&& f) const {
  for (std::size_t i = 0; i < sizes_.size(); ++i) {
    if (alone_[i] != 0) continue;
    for (const auto& [j, place] : by_row_[i]) {
      if (alone_[static_cast<std::size_t>(j)] == 0) f(places_[static_cast<std::size_t>(place)]);
    }
  }
}

void BlockLu::take_values(const BlockLu& from) {
  if (!from.has_alone_) {
    set_alone(from.alone_);
    values_ = from.values_;
    return;
  }
  clear();
  set_alone(from.alone_);
  const auto copy = [&](std::size_t first, std::size_t count) {
    std::copy_n(from.values_.begin() + static_cast<std::ptrdiff_t>(first), count,
                values_.begin() + static_cast<std::ptrdiff_t>(first));
  };
  for (const Pivot& pivot : pivots_) {
    copy(pivot.diagonal, static_cast<std::size_t>(pivot.stored * pivot.stored));
  }
  for_coupled([&](const Place& place) { copy(place.first, size_of(place)); });
}

void BlockLu::clear() {
  const auto zero = [&](std::size_t first, std::size_t count) {
    std::fill_n(values_.begin() + static_cast<std::ptrdiff_t>(first), count, 0.0);
  };
  if (!has_alone_) {
    zero(0, values_.size());
  } else {
    for_coupled([&](const Place& place) { zero(place.first, size_of(place)); });
  }
  for (const Pivot& pivot : pivots_) {
    if (has_alone_) zero(pivot.diagonal, static_cast<std::size_t>(pivot.stored * pivot.stored));
    for (int k = sizes_[static_cast<std::size_t>(pivot.block)]; k < pivot.stored; ++k) {
      values_[pivot.diagonal + static_cast<std::size_t>(k * pivot.stored + k)] = 1.0;
    }
  }
}

void BlockLu::set_alone(const std::vector<char>& blocks) {
  if (blocks == alone_) return;
  alone_ = blocks;
  has_alone_ = std::any_of(blocks.begin(), blocks.end(), [](char alone) { return alone != 0; });
  const auto is_alone = [&](int block) {
    return !blocks.empty() && blocks[static_cast<std::size_t>(block)] != 0;
  };
  for (Pivot& pivot : pivots_) pivot.is_alone = is_alone(pivot.block);
  for (Neighbour& other : neighbours_) {
    other.is_alone = pivots_[static_cast<std::size_t>(other.turn)].is_alone;
  }
}

double& BlockLu::diagonal(int row) { return values_[diagonal_[static_cast<std::size_t>(row)]]; }

template <int R>
bool BlockLu::eliminate() {
  // The original diagonal is kept in the workspace of solves.
  for (const Pivot& pivot : pivots_) {
    const int n = rows_of<R>(pivot.stored);
    for (int k = 0; k < n; ++k) {
      x_[pivot.first_stored + static_cast<std::size_t>(k)] =
          values_[pivot.diagonal + static_cast<std::size_t>(k * n + k)];
    }
  }
  double ratio = 1.0;
  double* const values = values_.data();
  for (const Pivot& pivot : pivots_) {
    double* const A = values + pivot.diagonal;
    double* const inverse = &inverse_[pivot.first_stored];
    const double share = factor_diagonal<R>(A, pivot.stored, inverse, &x_[pivot.first_stored]);
    if (share < 0.0) return false;
    ratio = std::min(ratio, share);
    if (pivot.is_alone) continue;
    for (std::size_t i = pivot.first_neighbour; i < pivot.end_neighbour; ++i) {
      const Neighbour& other = neighbours_[i];
      if (other.is_alone) continue;
      solve_lower<R>(A, pivot.stored, values + other.upper, other.stored);
      solve_upper<R>(A, pivot.stored, inverse, values + other.lower, other.stored);
    }
    update_later<R>(pivot);
  }
  pivot_ratio_ = ratio;
  return true;
}

/// Updates the blocks between all neighbours of a pivot.
template <int R>
void BlockLu::update_later(const Pivot& pivot) {
  double* const values = values_.data();
  const auto subtract = [&](const Neighbour& row, const Neighbour& column, std::size_t from) {
    subtract_product<R>(values + row.lower, values + column.upper, values + from, pivot.stored,
                        row.stored, column.stored);
  };
  for (std::size_t i = pivot.first_neighbour; i < pivot.end_neighbour; ++i) {
    const Neighbour& one = neighbours_[i];
    if (one.is_alone) continue;
    const Pivot& later = pivots_[static_cast<std::size_t>(one.turn)];
    subtract(one, one, later.diagonal);
    // Neighbours that come after it are neighbours of its own, in the same order.
    const Neighbour* own = neighbours_.data() + later.first_neighbour;
    for (std::size_t j = i + 1; j < pivot.end_neighbour; ++j) {
      const Neighbour& other = neighbours_[j];
      if (other.is_alone) continue;
      while (own->turn != other.turn) ++own;
      subtract(other, one, own->lower);
      subtract(one, other, own->upper);
    }
  }
}

template <int R>
void BlockLu::substitute() const {
  const double* const values = values_.data();
  double* const x = x_.data();
  for (const Pivot& pivot : pivots_) {
    double* const mine = x + pivot.first_stored;
    substitute_forward<R>(values + pivot.diagonal, pivot.stored, mine);
    if (pivot.is_alone) continue;
    for (std::size_t i = pivot.first_neighbour; i < pivot.end_neighbour; ++i) {
      const Neighbour& other = neighbours_[i];
      if (other.is_alone) continue;
      subtract_times<R>(values + other.lower, other.stored, pivot.stored, mine,
                        x + other.first_stored);
    }
  }
  substitute_backward<R>();
}

template <int R>
void BlockLu::substitute_backward() const {
  const double* const values = values_.data();
  double* const x = x_.data();
  for (std::size_t k = pivots_.size(); k-- > 0;) {
    const Pivot& pivot = pivots_[k];
    double* const mine = x + pivot.first_stored;
    const std::size_t end = pivot.is_alone ? pivot.first_neighbour : pivot.end_neighbour;
    for (std::size_t i = pivot.first_neighbour; i < end; ++i) {
      const Neighbour& other = neighbours_[i];
      if (other.is_alone) continue;
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
    case 4:
      return eliminate<4>();
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
    for (std::size_t k = 0; k < rows_.size(); ++k) f(x[rows_[k]], x_[stored_place_[k]]);
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
    case 4:
      substitute<4>();
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
