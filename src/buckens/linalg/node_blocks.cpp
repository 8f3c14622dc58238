// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/node_blocks.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <utility>

#include "buckens/linalg/column_content.h"
#include "buckens/linalg/counted_entries.h"

namespace buckens::linalg {

using Eigen::Index;

namespace {

constexpr double kWorthwhile = 2.0 / 3.0;

std::size_t as_index(Index k) { return static_cast<std::size_t>(k); }

template <class T>
double bytes_of(const std::vector<T>& list) {
  return static_cast<double>(sizeof(T)) * static_cast<double>(list.size());
}

bool is_same(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

}  // namespace

std::shared_ptr<const NodeBlocks> NodeBlocks::of(const SparseMatrix& A, TaskPool* pool) {
  if (A.rows() != A.cols() || A.rows() % 3 != 0 || A.rows() == 0 || !A.isCompressed()) return {};
  auto out = std::make_shared<NodeBlocks>();
  if (!out->take_rows(A)) return {};
  out->take_entries(A, pool);
  out->list_left();
  std::atomic<bool> is_mirrored = true;
  run_ranges(pool, static_cast<int>(A.cols()), [&](int begin, int end) {
    if (!out->is_mirrored(A, begin, end)) is_mirrored = false;
  });
  if (!is_mirrored) return {};
  return out;
}

bool NodeBlocks::take_rows(const SparseMatrix& A) {
  const Index nodes = A.cols() / 3;
  entries_ = A.nonZeros();
  begin_.reserve(as_index(nodes) + 1);
  rows_.reserve(as_index(entries_ / 9 + nodes) / 2);  // if all blocks are whole
  std::vector<int> seen_from(as_index(nodes), -1);
  for (int node = 0; node < nodes; ++node) {
    const auto first = static_cast<std::ptrdiff_t>(rows_.size());
    for (int column = 3 * node; column < 3 * node + 3; ++column) {
      for (SparseMatrix::InnerIterator it(A, column); it; ++it) {
        const int row = static_cast<int>(it.row()) / 3;
        if (row < node || seen_from[as_index(row)] == node) continue;
        seen_from[as_index(row)] = node;
        rows_.push_back(row);
      }
    }
    std::sort(rows_.begin() + first, rows_.end());
    if (first == static_cast<std::ptrdiff_t>(rows_.size()) || rows_[as_index(first)] != node) {
      return false;  // products begin a column with the block on the diagonal
    }
    begin_.push_back(static_cast<int>(rows_.size()));
  }
  rows_.shrink_to_fit();
  const auto blocks = static_cast<double>(rows_.size());
  const double of_block = 9.0 * sizeof(double) + sizeof(int) + sizeof(Left);
  const double of_entry = sizeof(double) + sizeof(int);
  return blocks * of_block <= kWorthwhile * of_entry * static_cast<double>(entries_);
}

void NodeBlocks::take_entries(const SparseMatrix& A, TaskPool* pool) {
  values_.assign(9 * rows_.size(), 0.0);
  masks_.assign(rows_.size(), 0);
  const auto take_column = [&](int column) {
    auto position = as_index(begin_[as_index(column / 3)]);
    for (SparseMatrix::InnerIterator it(A, column); it; ++it) {
      const int row = static_cast<int>(it.row());
      if (row / 3 < column / 3) continue;
      while (rows_[position] != row / 3) ++position;
      const int entry = 3 * (row % 3) + column % 3;
      values_[9 * position + as_index(entry)] = it.value();
      masks_[position] = static_cast<Mask>(masks_[position] | 1U << entry);
    }
  };
  run_ranges(pool, static_cast<int>(num_nodes()), [&](int begin, int end) {
    for (int column = 3 * begin; column < 3 * end; ++column) take_column(column);
  });
  if (std::all_of(masks_.begin(), masks_.end(), [](Mask mask) { return mask == kWhole; })) {
    std::vector<Mask>().swap(masks_);
  }
}

void NodeBlocks::list_left() {
  const auto nodes = static_cast<int>(num_nodes());
  left_begin_.assign(as_index(nodes) + 1, 0);
  for (const int row : rows_) ++left_begin_[as_index(row) + 1];
  for (int node = 0; node < nodes; ++node) --left_begin_[as_index(node) + 1];  // on the diagonal
  std::partial_sum(left_begin_.begin(), left_begin_.end(), left_begin_.begin());
  left_.resize(rows_.size() - as_index(nodes));
  std::vector<int> next(left_begin_.begin(), left_begin_.end() - 1);
  for (int node = 0; node < nodes; ++node) {
    for (int k = begin_[as_index(node)] + 1; k < begin_[as_index(node) + 1]; ++k) {
      left_[as_index(next[as_index(rows_[as_index(k)])]++)] = {node, k};
    }
  }
}

bool NodeBlocks::is_mirrored(const SparseMatrix& A, int begin, int end) const {
  // Entries below the diagonal blocks are those stored. Those above must be the same ones.
  for (int column = begin; column < end; ++column) {
    Column found(*this, column);
    for (SparseMatrix::InnerIterator it(A, column); it; ++it, ++found) {
      if (!found || found.row() != it.row() || !is_same(found.value(), it.value())) return false;
    }
    if (found) return false;
    const int first = column / 3 * 3;
    for (Column own(*this, column, first); own && own.row() < first + 3; ++own) {
      const Column across(*this, own.row(), column);
      const bool is_there = across && across.row() == column;
      if (!is_there || !is_same(across.value(), own.value())) return false;
    }
  }
  return true;
}

void NodeBlocks::read_nodes(int node, std::vector<int>& nodes) const {
  nodes.clear();
  for (int k = left_begin_[as_index(node)]; k < left_begin_[as_index(node) + 1]; ++k) {
    nodes.push_back(left_[as_index(k)].column);
  }
  nodes.insert(nodes.end(), rows_.begin() + begin_[as_index(node)],
               rows_.begin() + begin_[as_index(node) + 1]);
}

double NodeBlocks::bytes() const {
  return bytes_of(begin_) + bytes_of(rows_) + bytes_of(values_) + bytes_of(masks_) +
         bytes_of(left_begin_) + bytes_of(left_);
}

double NodeBlocks::coeff(Index row, Index column) const {
  if (row < column) std::swap(row, column);
  const auto begin = rows_.begin() + begin_[as_index(column / 3)];
  const auto end = rows_.begin() + begin_[as_index(column / 3 + 1)];
  const auto found = std::lower_bound(begin, end, static_cast<int>(row / 3));
  if (found == end || *found != row / 3) return 0.0;
  return values_[as_index(9 * (found - rows_.begin()) + 3 * (row % 3) + column % 3)];
}

Vector NodeBlocks::diagonal() const {
  Vector out(size());
  for (Index k = 0; k < out.size(); ++k) {
    out[k] = values_[as_index(9 * Index{begin_[as_index(k / 3)]} + 4 * (k % 3))];
  }
  return out;
}

double NodeBlocks::norm() const {
  double sum = 0;
  for (Index column = 0; column < size(); ++column) {
    for (Column it(*this, column); it; ++it) sum += it.value() * it.value();
  }
  return std::sqrt(sum);
}

std::array<std::uint64_t, 2> NodeBlocks::content() const {
  std::array<std::uint64_t, 2> sum{};
  for (int column = 0; column < size(); ++column) {
    for (Column it(*this, column, column); it; ++it) {
      add_content(static_cast<int>(it.row()), column, it.value(), sum);
    }
  }
  return sum;
}

bool NodeBlocks::is_finite() const {
  return std::all_of(values_.begin(), values_.end(), [](double x) { return std::isfinite(x); });
}

SparseMatrix NodeBlocks::whole() const {
  const auto n = static_cast<int>(size());
  return from_counted_entries(n, n, [this, n](auto&& entry) {
    for (int column = 0; column < n; ++column) {
      for (Column it(*this, column); it; ++it) {
        entry(static_cast<int>(it.row()), column, it.value());
      }
    }
  });
}

void NodeBlocks::multiply(const double* x, double* y) const {
  std::fill_n(y, size(), 0.0);
  add_product(x, y);
}

void NodeBlocks::add_product(const double* x, double* y) const {
  const auto nodes = static_cast<std::ptrdiff_t>(num_nodes());
  const double* B = values_.data();
  for (std::ptrdiff_t node = 0; node < nodes; ++node) {
    const double x0 = x[3 * node], x1 = x[3 * node + 1], x2 = x[3 * node + 2];
    // Each sum goes by ascending columns: its terms left of the diagonal are there.
    double y0 = y[3 * node], y1 = y[3 * node + 1], y2 = y[3 * node + 2];
    const int end = begin_[as_index(node + 1)];
    int k = begin_[as_index(node)];
    y0 = y0 + B[0] * x0 + B[1] * x1 + B[2] * x2;
    y1 = y1 + B[3] * x0 + B[4] * x1 + B[5] * x2;
    y2 = y2 + B[6] * x0 + B[7] * x1 + B[8] * x2;
    for (++k, B += 9; k < end; ++k, B += 9) {
      const std::ptrdiff_t at = 3 * static_cast<std::ptrdiff_t>(rows_[as_index(k)]);
      const double* u = x + at;
      double* v = y + at;
      v[0] = v[0] + B[0] * x0 + B[1] * x1 + B[2] * x2;
      v[1] = v[1] + B[3] * x0 + B[4] * x1 + B[5] * x2;
      v[2] = v[2] + B[6] * x0 + B[7] * x1 + B[8] * x2;
      const double u0 = u[0], u1 = u[1], u2 = u[2];
      y0 = y0 + B[0] * u0 + B[3] * u1 + B[6] * u2;
      y1 = y1 + B[1] * u0 + B[4] * u1 + B[7] * u2;
      y2 = y2 + B[2] * u0 + B[5] * u1 + B[8] * u2;
    }
    y[3 * node] = y0;
    y[3 * node + 1] = y1;
    y[3 * node + 2] = y2;
  }
}

}  // namespace buckens::linalg
