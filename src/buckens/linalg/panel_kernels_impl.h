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

// The same for several right-hand sides. Each pass over a block asks for its share of what lies
// this far ahead, so that memory works while the processor computes; more than a block, of which
// the first pass reads all.
constexpr std::ptrdiff_t kAheadOfSides = 10240;

/// `Wide` registers of right-hand sides beside each other: a value of the factor is read once for
/// all of them. The eight rows of a block take `kPasses` passes, so that sums fit into registers.
template <int Lanes, int Wide>
struct Sides {
  using V = typename Simd<Lanes>::Register;
  static constexpr int kCount = Lanes * Wide;
  // AVX-512 has 32 registers, the others 16.
  static constexpr int kPasses = Wide > 1 && Lanes < 8 ? 2 : 1;
  static constexpr int kRows = kPanelRows / kPasses;
  V part[Wide];

  static Sides load(const double* p) {
    Sides out;
#pragma GCC unroll 2
    for (int w = 0; w < Wide; ++w) out.part[w] = Simd<Lanes>::load(p + w * Lanes);
    return out;
  }
  void store(double* p) const {
#pragma GCC unroll 2
    for (int w = 0; w < Wide; ++w) Simd<Lanes>::store(p + w * Lanes, part[w]);
  }
  void add(double value, const Sides& x) {
#pragma GCC unroll 2
    for (int w = 0; w < Wide; ++w) part[w] += value * x.part[w];
  }

  Sides negative() const {
    Sides out;
#pragma GCC unroll 2
    for (int w = 0; w < Wide; ++w) out.part[w] = -part[w];
    return out;
  }
  /// Bytes to be fetched with each column, so that all passes over a block fetch as much as it has.
  static std::ptrdiff_t share(int sides) {
    constexpr int kLine = kPanelRows * sizeof(double);
    return (kLine * kCount + sides * kPasses - 1) / (sides * kPasses);
  }
};

/// row i of sum = Σ_c (i, c) of the block · y_c, for the rows of one pass. @param values of these
/// rows in the first column
template <class S>
inline void multiply_block_sides(const double* values, int columns, const double* y, int sides,
                                 const char*& fetch, S* sum) {
  const std::ptrdiff_t share = S::share(sides);
  S acc[S::kRows] = {};
  for (int c = 0; c < columns; ++c, values += kPanelRows, y += sides) {
    __builtin_prefetch(fetch);
    fetch += share;
    const S side = S::load(y);
#pragma GCC unroll 8
    for (int i = 0; i < S::kRows; ++i) acc[i].add(values[i], side);
  }
#pragma GCC unroll 8
  for (int i = 0; i < S::kRows; ++i) sum[i] = acc[i];
}

/// y_c += Σ_i (i, c) of the block · x_i, for the rows of one pass. @param end of the block, by as
/// much higher as these rows are
template <class S>
inline void add_block_sides(const double* end, int columns, const S* x, int sides,
                            const char*& fetch, double* y) {
  const std::ptrdiff_t share = S::share(sides);
  S row[S::kRows];
#pragma GCC unroll 8
  for (int i = 0; i < S::kRows; ++i) row[i] = x[i];
  const double* values = end;
  y += static_cast<std::ptrdiff_t>(columns) * sides;
  for (int c = columns - 1; c >= 0; --c) {
    values -= kPanelRows;
    y -= sides;
    __builtin_prefetch(fetch);
    fetch -= share;
    S sum = S::load(y);
#pragma GCC unroll 8
    for (int i = 0; i < S::kRows; ++i) sum.add(values[i], row[i]);
    sum.store(y);
  }
}

/// Calls f<Sides>(first right-hand side) until all are done: pairs of registers, then single ones.
template <int Lanes, class F>
inline void for_sides(int sides, F&& f) {
  int r = 0;
  for (; r + 2 * Lanes <= sides; r += 2 * Lanes) f.template operator()<Sides<Lanes, 2>>(r);
  for (; r + Lanes <= sides; r += Lanes) f.template operator()<Sides<Lanes, 1>>(r);
  if constexpr (Lanes > side_multiple()) {
    for (; r < sides; r += side_multiple()) f.template operator()<Sides<side_multiple(), 1>>(r);
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
    const char* fetch = reinterpret_cast<const char*>(values) + kAheadOfSides;
    for_sides<Lanes>(sides, [&]<class S>(int r) {
      for (int pass = 0; pass < S::kPasses; ++pass) {
        S sum[S::kRows];
        const int above = pass * S::kRows;
        multiply_block_sides<S>(values + above, columns, own + r, sides, fetch, sum);
        const int row = kPanelRows * b + above;
        for (int i = 0; i < S::kRows && row + i < panel.columns; ++i) {
          sum[i].store(y + (row + i) * stride + r);
        }
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
    const char* fetch = reinterpret_cast<const char*>(values) + kAheadOfSides;
    for_sides<Lanes>(sides, [&]<class S>(int r) {
      for (int pass = 0; pass < S::kPasses; ++pass) {
        S sum[S::kRows];
        const int above = pass * S::kRows;
        multiply_block_sides<S>(values + above, panel.columns, own + r, sides, fetch, sum);
#pragma GCC unroll 8
        for (int i = 0; i < S::kRows; ++i) {
          double* at_row = x + rows[above + i] * stride + r;
          S left = S::load(at_row);
          left.add(-1.0, sum[i]);
          left.store(at_row);
        }
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
    const char* fetch = reinterpret_cast<const char*>(values - beyond) - kAheadOfSides;
    for_sides<Lanes>(sides, [&]<class S>(int r) {
      for (int pass = 0; pass < S::kPasses; ++pass) {
        const int above = pass * S::kRows;
        S at_rows[S::kRows];
#pragma GCC unroll 8
        for (int i = 0; i < S::kRows; ++i) {
          at_rows[i] = S::load(x + rows[above + i] * stride + r).negative();
        }
        add_block_sides<S>(values - beyond + above, end - begin, at_rows, sides, fetch, own + r);
      }
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
    const char* fetch = reinterpret_cast<const char*>(end) - kAheadOfSides;
    for_sides<Lanes>(sides, [&]<class S>(int r) {
      for (int pass = 0; pass < S::kPasses; ++pass) {
        const int above = pass * S::kRows;
        const int row = kPanelRows * b + above;
        S right[S::kRows] = {};
        for (int i = 0; i < S::kRows && row + i < panel.columns; ++i) {
          right[i] = S::load(own + (row + i) * stride + r);
        }
        add_block_sides<S>(end + above, columns, right, sides, fetch, y + r);
      }
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
