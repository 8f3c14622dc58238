// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/front.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <utility>
#include <vector>

#include <cblas.h>

#include "buckens/linalg/single_thread.h"

// LAPACK, in OpenBLAS.
extern "C" void dpotrf_(const char* part, const int* size, double* values, const int* stride,
                        int* failed);

namespace buckens::linalg {

namespace {

constexpr int kTile = Trapezoid::kBlock;

/// Lower triangle of C ← C − X Xᵀ. @param n rows of X @param k columns of X
void subtract_square(double* C, int c_stride, const double* X, int x_stride, int n, int k) {
  cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, n, k, -1.0, X, x_stride, 1.0, C, c_stride);
}

/// C ← C − X Yᵀ. @param m,n rows of X and of Y @param k columns of both
void subtract_product(double* C, int c_stride, const double* X, int x_stride, const double* Y,
                      int y_stride, int m, int n, int k) {
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, m, n, k, -1.0, X, x_stride, Y, y_stride, 1.0,
              C, c_stride);
}

/// Rows that follow one another in both fronts: what makes adding them fast.
struct Run {
  int begin, place, count;
};

std::vector<Run> runs_of(std::span<const int> places) {
  std::vector<Run> runs;
  for (int i = 0; i < static_cast<int>(places.size()); ++i) {
    const int place = places[static_cast<std::size_t>(i)];
    if (runs.empty() || runs.back().place + runs.back().count != place) {
      runs.push_back({i, place, 0});
    }
    ++runs.back().count;
  }
  return runs;
}

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
  run_tasks(pool, own_.blocks() + rest_.blocks(), [&](int k) {
    const bool is_own = k < own_.blocks();
    const Trapezoid& part = is_own ? own_ : rest_;
    const int p = is_own ? k : k - own_.blocks();
    double* values = (is_own ? own : rest) + part.offset(p);
    std::fill_n(values, static_cast<std::ptrdiff_t>(part.stride(p)) * part.width(p), 0.0);
  });
}

void Front::add(const double* rest, std::span<const int> places, TaskPool* pool) {
  const int count = static_cast<int>(places.size());
  const std::vector<Run> runs = runs_of(places);
  const Trapezoid source{count, count};
  run_tasks(pool, source.blocks(), [&](int p) {
    std::size_t first = 0;  // run that column j belongs to
    for (int j = p * kTile; j < p * kTile + source.width(p); ++j) {
      const double* from = source.column(rest, j);
      double* to = column(places[static_cast<std::size_t>(j)]);
      while (runs[first].begin + runs[first].count <= j) ++first;
      for (std::size_t r = first; r < runs.size(); ++r) {
        const Run& run = runs[r];
        const int begin = std::max(run.begin, j);
        double* at = to + run.place + (begin - run.begin);
        const double* values = from + begin;
        const int length = run.begin + run.count - begin;
        for (int i = 0; i < length; ++i) at[i] += values[i];
      }
    }
  });
}

int Front::eliminate(TaskPool* pool) {
  int failed = -1;
  for (int p = 0; p < own_.blocks() && failed < 0; ++p) {
    const int first = p * kTile;
    const int end = first + own_.width(p);
    const RowTiles below(end, own_.rows);
    // Task 0 begins first and throws nothing, so that those which wait for it go on.
    std::atomic<bool> is_factorised = false;  // the block of the diagonal
    run_tasks(pool, 1 + below.count, [&](int t) {
      if (t == 0) {
        update_tile(p, first, end - first);
        factorise_diagonal(p, failed);
        is_factorised = true;
        is_factorised.notify_all();
        return;
      }
      update_tile(p, below.row(t - 1), below.rows(t - 1));
      is_factorised.wait(false);
      if (failed < 0) divide_tile(p, below.row(t - 1), below.rows(t - 1));
    });
  }
  if (failed >= 0) return failed;
  std::vector<std::pair<int, int>> tiles;  // block and first row
  for (int q = 0; q < rest_.blocks(); ++q) {
    for (int row = q * kTile; row < rest_.rows; row += kTile) tiles.emplace_back(q, row);
  }
  run_tasks(pool, static_cast<int>(tiles.size()), [&](int t) {
    const auto [q, row] = tiles[static_cast<std::size_t>(t)];
    update_rest(q, row, std::min(kTile, rest_.rows - row));
  });
  return failed;
}

/// Subtracts what the blocks before p contribute to some of its rows.
void Front::update_tile(int p, int row, int rows) {
  const SingleThread alone;
  const int first = p * kTile;
  double* C = own_.block(own_values_, p, row);
  for (int q = 0; q < p; ++q) {
    const double* X = own_.block(own_values_, q, row);
    if (row == first) {
      subtract_square(C, own_.stride(p), X, own_.stride(q), rows, kTile);
    } else {
      subtract_product(C, own_.stride(p), X, own_.stride(q), own_.block(own_values_, q, first),
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
      subtract_square(C, rest_.stride(q), X, own_.stride(p), rows, own_.width(p));
    } else {
      subtract_product(C, rest_.stride(q), X, own_.stride(p),
                       own_.block(own_values_, p, own_.columns + first), own_.stride(p), rows,
                       rest_.width(q), own_.width(p));
    }
  }
}

}  // namespace buckens::linalg
