// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "buckens/linalg/panel_kernels.h"

// Included by the sources panel_kernels_*.cpp only, each compiled for another instruction set. The
// unnamed namespace keeps their instances apart; functions of the standard library must not be used
// here, or one compiled for AVX-512 could end up in the whole program.
namespace buckens::linalg {
namespace {

/// `Lanes` doubles in one register.
template <int Lanes>
struct Simd {
  typedef double Register __attribute__((vector_size(8 * Lanes)));

  static Register load(const double* p) {
    Register out;
    __builtin_memcpy(&out, p, sizeof out);
    return out;
  }
  static void store(double* p, const Register& value) { __builtin_memcpy(p, &value, sizeof value); }
};

// Far enough ahead to hide memory latency, near enough to stay in the L1 cache.
constexpr std::ptrdiff_t kAhead = 4096 / sizeof(double);

struct alignas(64) Line {
  double value[kPanelRows];
};

/// sum = Σ_c column c of the block · y_c, for one right-hand side.
template <int Lanes>
inline void multiply_block(const double* values, int columns, const double* y, Line& sum) {
  using V = typename Simd<Lanes>::Register;
  constexpr int kParts = kPanelRows / Lanes;
  V even[kParts] = {}, odd[kParts] = {};
  int c = 0;
  for (; c + 1 < columns; c += 2, values += 2 * kPanelRows) {
    __builtin_prefetch(values + kAhead);
    __builtin_prefetch(values + kAhead + kPanelRows);
#pragma GCC unroll 8
    for (int p = 0; p < kParts; ++p) {
      even[p] += Simd<Lanes>::load(values + p * Lanes) * y[c];
      odd[p] += Simd<Lanes>::load(values + kPanelRows + p * Lanes) * y[c + 1];
    }
  }
  if (c < columns) {
    __builtin_prefetch(values + kAhead);
#pragma GCC unroll 8
    for (int p = 0; p < kParts; ++p) even[p] += Simd<Lanes>::load(values + p * Lanes) * y[c];
  }
#pragma GCC unroll 8
  for (int p = 0; p < kParts; ++p) {
    Simd<Lanes>::store(sum.value + p * Lanes, even[p] + odd[p]);
  }
}

/// sum_c += column c of the block, elementwise times x; reads downwards from `end`.
template <int Lanes>
inline void add_block(const double* end, int columns, const Line& x, Line* sum) {
  using V = typename Simd<Lanes>::Register;
  constexpr int kParts = kPanelRows / Lanes;
  V factor[kParts];
#pragma GCC unroll 8
  for (int p = 0; p < kParts; ++p) factor[p] = Simd<Lanes>::load(x.value + p * Lanes);
  const double* values = end;
  for (int c = columns - 1; c >= 0; --c) {
    values -= kPanelRows;
    __builtin_prefetch(values - kAhead);
#pragma GCC unroll 8
    for (int p = 0; p < kParts; ++p) {
      double* to = sum[c].value + p * Lanes;
      Simd<Lanes>::store(to,
                         Simd<Lanes>::load(to) + Simd<Lanes>::load(values + p * Lanes) * factor[p]);
    }
  }
}

inline double total(const Line& line) {
  const double* v = line.value;
  return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}

inline void clear(Line* lines, int count) {
  for (int c = 0; c < count; ++c) {
#pragma GCC unroll 8
    for (int i = 0; i < kPanelRows; ++i) lines[c].value[i] = 0.0;
  }
}

/// Values of row block b of a panel, behind its triangle.
inline const double* row_block(const Panel& panel, int b) {
  const std::ptrdiff_t lines =
      panel.num_lines() - static_cast<std::ptrdiff_t>(panel.row_blocks - b) * panel.columns;
  return panel.values + kPanelRows * lines;
}

template <int Lanes>
inline void forward_triangle_one(const Panel& panel, double* x) {
  const double* values = panel.values;
  Line y[kPanelColumns / kPanelRows];
  double* own = x + panel.first;
  const int triangles = panel.triangle_blocks();
  for (int b = 0; b < triangles; ++b) {
    const int columns = panel.triangle_columns(b);
    multiply_block<Lanes>(values, columns, own, y[b]);
    values += static_cast<std::ptrdiff_t>(kPanelRows) * columns;
  }
  const double* solved = y[0].value;
  for (int c = 0; c < panel.columns; ++c) own[c] = solved[c];
}

template <int Lanes>
inline void forward_rows_one(const Panel& panel, int begin, int end, double* x) {
  Line y[kPanelColumns / kPanelRows];  // rows may be anywhere in x, the compiler fears
  double* solved = y[0].value;
  for (int c = 0; c < panel.columns; ++c) solved[c] = x[panel.first + c];
  const double* values = row_block(panel, begin);
  const int* rows = panel.rows + static_cast<std::ptrdiff_t>(kPanelRows) * begin;
  for (int b = begin; b < end; ++b, rows += kPanelRows) {
    Line sum;
    multiply_block<Lanes>(values, panel.columns, solved, sum);
    values += static_cast<std::ptrdiff_t>(kPanelRows) * panel.columns;
#pragma GCC unroll 8
    for (int i = 0; i < kPanelRows; ++i) x[rows[i]] -= sum.value[i];
  }
}

template <int Lanes>
inline void backward_rows_one(const Panel& panel, int begin, int end, double* x) {
  const std::ptrdiff_t beyond = static_cast<std::ptrdiff_t>(kPanelRows) * (panel.columns - end);
  const double* values = panel.values + kPanelRows * panel.num_lines();
  Line sum[kPanelColumns];
  clear(sum, end - begin);
  const int* rows = panel.rows + static_cast<std::ptrdiff_t>(kPanelRows) * panel.row_blocks;
  for (int b = panel.row_blocks - 1; b >= 0; --b) {
    rows -= kPanelRows;
    Line at_rows;
#pragma GCC unroll 8
    for (int i = 0; i < kPanelRows; ++i) at_rows.value[i] = x[rows[i]];
    add_block<Lanes>(values - beyond, end - begin, at_rows, sum);
    values -= static_cast<std::ptrdiff_t>(kPanelRows) * panel.columns;
  }
  double* own = x + panel.first + begin;
  for (int c = 0; c < end - begin; ++c) own[c] -= total(sum[c]);
}

template <int Lanes>
inline void backward_triangle_one(const Panel& panel, double* x) {
  Line sum[kPanelColumns];
  Line y[kPanelColumns / kPanelRows];
  const double* end = row_block(panel, 0);
  double* own = x + panel.first;
  double* right = y[0].value;
  const int triangles = panel.triangle_blocks();
  clear(y + triangles - 1, 1);
  for (int c = 0; c < panel.columns; ++c) right[c] = own[c];
  clear(sum, panel.columns);
  for (int b = triangles - 1; b >= 0; --b) {
    const int columns = panel.triangle_columns(b);
    add_block<Lanes>(end, columns, y[b], sum);
    end -= static_cast<std::ptrdiff_t>(kPanelRows) * columns;
  }
  for (int c = 0; c < panel.columns; ++c) own[c] = total(sum[c]);
}

/// row i of sum = Σ_c (i, c) of the block · y_c, for `Lanes` right-hand sides of `sides`.
template <int Lanes>
inline void multiply_block_sides(const double* values, int columns, const double* y, int sides,
                                 bool must_fetch, typename Simd<Lanes>::Register* sum) {
  using V = typename Simd<Lanes>::Register;
  V acc[kPanelRows] = {};
  for (int c = 0; c < columns; ++c, values += kPanelRows, y += sides) {
    if (must_fetch) __builtin_prefetch(values + kAhead);
    const V side = Simd<Lanes>::load(y);
#pragma GCC unroll 8
    for (int i = 0; i < kPanelRows; ++i) acc[i] += values[i] * side;
  }
#pragma GCC unroll 8
  for (int i = 0; i < kPanelRows; ++i) sum[i] = acc[i];
}

/// y_c += Σ_i (i, c) of the block · x_i, or −=, for `Lanes` right-hand sides of `sides`.
template <int Lanes, bool kSubtract>
inline void add_block_sides(const double* end, int columns, const typename Simd<Lanes>::Register* x,
                            int sides, bool must_fetch, double* y) {
  using V = typename Simd<Lanes>::Register;
  V row[kPanelRows];
#pragma GCC unroll 8
  for (int i = 0; i < kPanelRows; ++i) row[i] = x[i];
  const double* values = end;
  y += static_cast<std::ptrdiff_t>(columns) * sides;
  for (int c = columns - 1; c >= 0; --c) {
    values -= kPanelRows;
    y -= sides;
    if (must_fetch) __builtin_prefetch(values - kAhead);
    V low = values[0] * row[0];
    V high = values[4] * row[4];
#pragma GCC unroll 4
    for (int i = 1; i < 4; ++i) {
      low += values[i] * row[i];
      high += values[4 + i] * row[4 + i];
    }
    const V before = Simd<Lanes>::load(y);
    Simd<Lanes>::store(y, kSubtract ? before - (low + high) : before + (low + high));
  }
}

/// Calls f<Lanes>(first right-hand side) until all are done: wide registers, then narrow ones.
template <int Lanes, class F>
inline void for_sides(int sides, F&& f) {
  int r = 0;
  for (; r + Lanes <= sides; r += Lanes) f.template operator()<Lanes>(r);
  if constexpr (Lanes > side_multiple()) {
    for (; r < sides; r += side_multiple()) f.template operator()<side_multiple()>(r);
  }
}

template <int Lanes>
inline void forward_triangle_several(const Panel& panel, double* x, int sides) {
  const double* values = panel.values;
  alignas(64) double y[kPanelColumns * kMostSides];
  const std::ptrdiff_t stride = sides;
  double* own = x + panel.first * stride;
  const int triangles = panel.triangle_blocks();
  for (int b = 0; b < triangles; ++b) {
    const int columns = panel.triangle_columns(b);
    for_sides<Lanes>(sides, [&]<int L>(int r) {
      typename Simd<L>::Register sum[kPanelRows];
      multiply_block_sides<L>(values, columns, own + r, sides, r == 0, sum);
      for (int i = 0; i < kPanelRows && kPanelRows * b + i < panel.columns; ++i) {
        Simd<L>::store(y + (kPanelRows * b + i) * stride + r, sum[i]);
      }
    });
    values += static_cast<std::ptrdiff_t>(kPanelRows) * columns;
  }
  for (std::ptrdiff_t k = 0; k < panel.columns * stride; ++k) own[k] = y[k];
}

template <int Lanes>
inline void forward_rows_several(const Panel& panel, int begin, int end, double* x, int sides) {
  const std::ptrdiff_t stride = sides;
  const double* own = x + panel.first * stride;
  const double* values = row_block(panel, begin);
  const int* rows = panel.rows + static_cast<std::ptrdiff_t>(kPanelRows) * begin;
  for (int b = begin; b < end; ++b, rows += kPanelRows) {
    for_sides<Lanes>(sides, [&]<int L>(int r) {
      typename Simd<L>::Register sum[kPanelRows];
      multiply_block_sides<L>(values, panel.columns, own + r, sides, r == 0, sum);
#pragma GCC unroll 8
      for (int i = 0; i < kPanelRows; ++i) {
        double* at_row = x + rows[i] * stride + r;
        Simd<L>::store(at_row, Simd<L>::load(at_row) - sum[i]);
      }
    });
    values += static_cast<std::ptrdiff_t>(kPanelRows) * panel.columns;
  }
}

template <int Lanes>
inline void backward_rows_several(const Panel& panel, int begin, int end, double* x, int sides) {
  const std::ptrdiff_t beyond = static_cast<std::ptrdiff_t>(kPanelRows) * (panel.columns - end);
  const double* values = panel.values + kPanelRows * panel.num_lines();
  const std::ptrdiff_t stride = sides;
  double* own = x + (panel.first + begin) * stride;
  const int* rows = panel.rows + static_cast<std::ptrdiff_t>(kPanelRows) * panel.row_blocks;
  for (int b = panel.row_blocks - 1; b >= 0; --b) {
    rows -= kPanelRows;
    for_sides<Lanes>(sides, [&]<int L>(int r) {
      typename Simd<L>::Register at_rows[kPanelRows];
#pragma GCC unroll 8
      for (int i = 0; i < kPanelRows; ++i) at_rows[i] = Simd<L>::load(x + rows[i] * stride + r);
      add_block_sides<L, true>(values - beyond, end - begin, at_rows, sides, r == 0, own + r);
    });
    values -= static_cast<std::ptrdiff_t>(kPanelRows) * panel.columns;
  }
}

template <int Lanes>
inline void backward_triangle_several(const Panel& panel, double* x, int sides) {
  const double* end = row_block(panel, 0);
  alignas(64) double y[kPanelColumns * kMostSides];
  const std::ptrdiff_t stride = sides;
  double* own = x + panel.first * stride;
  for (std::ptrdiff_t k = 0; k < panel.columns * stride; ++k) y[k] = 0.0;
  for (int b = panel.triangle_blocks() - 1; b >= 0; --b) {
    const int columns = panel.triangle_columns(b);
    for_sides<Lanes>(sides, [&]<int L>(int r) {
      typename Simd<L>::Register right[kPanelRows] = {};
      for (int i = 0; i < kPanelRows && kPanelRows * b + i < panel.columns; ++i) {
        right[i] = Simd<L>::load(own + (kPanelRows * b + i) * stride + r);
      }
      add_block_sides<L, false>(end, columns, right, sides, r == 0, y + r);
    });
    end -= static_cast<std::ptrdiff_t>(kPanelRows) * columns;
  }
  for (std::ptrdiff_t k = 0; k < panel.columns * stride; ++k) own[k] = y[k];
}

template <int Lanes>
void forward_triangle(const Panel& panel, double* x, int sides) {
  if (sides == 1) {
    forward_triangle_one<Lanes>(panel, x);
  } else {
    forward_triangle_several<Lanes>(panel, x, sides);
  }
}

template <int Lanes>
void forward_rows(const Panel& panel, int begin, int end, double* x, int sides) {
  if (sides == 1) {
    forward_rows_one<Lanes>(panel, begin, end, x);
  } else {
    forward_rows_several<Lanes>(panel, begin, end, x, sides);
  }
}

template <int Lanes>
void backward_rows(const Panel& panel, int begin, int end, double* x, int sides) {
  if (sides == 1) {
    backward_rows_one<Lanes>(panel, begin, end, x);
  } else {
    backward_rows_several<Lanes>(panel, begin, end, x, sides);
  }
}

template <int Lanes>
void backward_triangle(const Panel& panel, double* x, int sides) {
  if (sides == 1) {
    backward_triangle_one<Lanes>(panel, x);
  } else {
    backward_triangle_several<Lanes>(panel, x, sides);
  }
}

template <int Lanes>
void forward_panels(const Panel* begin, const Panel* end, double* x, int sides) {
  for (const Panel* panel = begin; panel != end; ++panel) {
    forward_triangle<Lanes>(*panel, x, sides);
    forward_rows<Lanes>(*panel, 0, panel->row_blocks, x, sides);
  }
}

template <int Lanes>
void backward_panels(const Panel* begin, const Panel* end, double* x, int sides) {
  for (const Panel* panel = end; panel != begin;) {
    --panel;
    backward_rows<Lanes>(*panel, 0, panel->columns, x, sides);
    backward_triangle<Lanes>(*panel, x, sides);
  }
}

template <int Lanes>
constexpr PanelKernels kernels_of() {
  return {forward_panels<Lanes>, backward_panels<Lanes>, forward_triangle<Lanes>,
          forward_rows<Lanes>,   backward_rows<Lanes>,   backward_triangle<Lanes>};
}

}  // namespace
}  // namespace buckens::linalg
