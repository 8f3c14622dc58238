// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/front.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <utility>
#include <vector>

#include <cblas.h>

#include "buckens/linalg/row_runs.h"
#include "buckens/linalg/single_thread.h"
#include "buckens/linalg/tile_products.h"

// LAPACK, in OpenBLAS.
extern "C" void dpotrf_(const char* part, const int* size, double* values, const int* stride,
                        int* failed);

namespace buckens::linalg {

namespace {

constexpr int kTile = Trapezoid::kBlock;

/// The rows from `begin` to `end` in equal tiles, none higher than kTile: an even number of them,
/// so that two threads have the same to do, or one where there is little to do.
struct RowTiles {
  RowTiles(int from, int to) : begin(from), end(to) {
    const int pairs = (to - from + 2 * kTile - 1) / (2 * kTile);
    count = to - from > kTile / 2 ? 2 * pairs : pairs;
  }

  int begin, end, count;
  int row(int t) const { return begin + static_cast<int>(std::int64_t{end - begin} * t / count); }
  int rows(int t) const { return row(t + 1) - row(t); }
};

}  // namespace

void Front::begin(double* own, double* rest, TaskPool* pool) {
  own_values_ = own;
  rest_values_ = rest;
  run_tasks(pool, own_.blocks() + (rest != nullptr ? rest_.blocks() : 0), [&](int k) {
    const bool is_own = k < own_.blocks();
    const Trapezoid& part = is_own ? own_ : rest_;
    const int p = is_own ? k : k - own_.blocks();
    double* values = (is_own ? own : rest) + part.offset(p);
    std::fill_n(values, static_cast<std::ptrdiff_t>(part.stride(p)) * part.width(p), 0.0);
  });
}

void Front::add(const double* rest, std::span<const int> places, TaskPool* pool) {
  const int count = static_cast<int>(places.size());
  const RowRuns runs(places);
  const Trapezoid source{count, count};
  run_tasks(pool, source.blocks(), [&](int p) {
    for (int j = p * kTile; j < p * kTile + source.width(p); ++j) {
      runs.add(source.column(rest, j) + j, j, count, column(places[static_cast<std::size_t>(j)]));
    }
  });
}

int Front::eliminate_blocks(int begin, int end, TaskPool* pool) {
  int failed = -1;
  for (int p = begin; p < end && failed < 0; ++p) {
    const int first = p * kTile;
    const int past = first + own_.width(p);
    const RowTiles below(past, own_.rows);
    // Task 0 begins first and throws nothing, so that those which wait for it go on.
    std::atomic<bool> is_factorised = false;  // the block of the diagonal
    run_tasks(pool, 1 + below.count, [&](int t) {
      if (t == 0) {
        update_tile(begin, p, first, past - first);
        factorise_diagonal(p, failed);
        is_factorised = true;
        is_factorised.notify_all();
        return;
      }
      update_tile(begin, p, below.row(t - 1), below.rows(t - 1));
      is_factorised.wait(false);
      if (failed < 0) divide_tile(p, below.row(t - 1), below.rows(t - 1));
    });
  }
  return failed;
}

int Front::eliminate(TaskPool* pool) {
  const int failed = eliminate_blocks(0, own_.blocks(), pool);
  if (failed >= 0) return failed;
  std::vector<std::pair<int, int>> tiles;  // block and first row
  for (int q = 0; q < rest_.blocks(); ++q) {
    for (int row = q * kTile; row < rest_.rows; row += kTile) tiles.emplace_back(q, row);
  }
  run_tasks(pool, static_cast<int>(tiles.size()), [&](int t) {
    const auto [q, row] = tiles[static_cast<std::size_t>(t)];
    update_rest(q, row, std::min(kTile, rest_.rows - row));
  });
  return -1;
}

/// Subtracts what the blocks from `begin` to p contribute to some rows of p.
void Front::update_tile(int begin, int p, int row, int rows) {
  const SingleThread alone;
  const int first = p * kTile;
  double* C = own_.block(own_values_, p, row);
  for (int q = begin; q < p; ++q) {
    const double* X = own_.block(own_values_, q, row);
    if (row == first) {
      subtract_square(1.0, C, own_.stride(p), X, own_.stride(q), rows, kTile);
    } else {
      subtract_product(1.0, C, own_.stride(p), X, own_.stride(q), own_.block(own_values_, q, first),
                       own_.stride(q), rows, own_.width(p), kTile);
    }
  }
}

void Front::factorise_diagonal(int p, int& failed) {
  const SingleThread alone;
  const int size = own_.width(p);
  const int stride = own_.stride(p);
  double* values = own_.block(own_values_, p, p * kTile);
  int info = 0;
  dpotrf_("L", &size, values, &stride, &info);
  for (int k = 0; info == 0 && k < size; ++k) {  // LAPACK lets some numbers that are none pass
    if (!(values[static_cast<std::ptrdiff_t>(k) * stride + k] > 0.0)) info = k + 1;
  }
  if (info != 0) failed = p * kTile + info - 1;
}

void Front::divide_tile(int p, int row, int rows) {
  const SingleThread alone;
  cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, rows, own_.width(p),
              1.0, own_.block(own_values_, p, p * kTile), own_.stride(p),
              own_.block(own_values_, p, row), own_.stride(p));
}

void Front::update_rest(int q, int row, int rows) {
  const SingleThread alone;
  const int first = q * kTile;
  double* C = rest_.block(rest_values_, q, row);
  for (int p = 0; p < own_.blocks(); ++p) {
    const double* X = own_.block(own_values_, p, own_.columns + row);
    if (row == first) {
      subtract_square(1.0, C, rest_.stride(q), X, own_.stride(p), rows, own_.width(p));
    } else {
      subtract_product(1.0, C, rest_.stride(q), X, own_.stride(p),
                       own_.block(own_values_, p, own_.columns + first), own_.stride(p), rows,
                       rest_.width(q), own_.width(p));
    }
  }
}

}  // namespace buckens::linalg
