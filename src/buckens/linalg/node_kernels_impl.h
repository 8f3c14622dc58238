// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "buckens/linalg/node_kernels.h"

// All functions with arguments of this kind are inlined.
#pragma GCC diagnostic ignored "-Wpsabi"

// Included by the sources node_kernels_*.cpp only, each compiled for another instruction set: see
// panel_kernels_impl.h.
namespace buckens::linalg {
namespace {

/// Three variables of a node; the fourth number is whatever follows.
typedef double Four __attribute__((vector_size(32)));

inline Four load_four(const double* p) {
  Four out;
  __builtin_memcpy(&out, p, sizeof out);
  return out;
}
inline void store_four(double* p, const Four& value) { __builtin_memcpy(p, &value, sizeof value); }

/// Reads no further than the three variables: for the last node of a vector.
inline Four load_three(const double* p) { return Four{p[0], p[1], p[2], 0.0}; }

/// The variables of a node. @param last node behind which nothing may be read, at the end of the
/// vector or where another thread writes
inline Four load_node(const double* x, int node, int last) {
  const double* p = x + 3 * static_cast<std::ptrdiff_t>(node);
  return node == last ? load_three(p) : load_four(p);
}
inline void store_node(double* p, const Four& value) {
  p[0] = value[0];
  p[1] = value[1];
  p[2] = value[2];
}

/// Products of one column of M with `Count` vectors. Four sums of each hide how long one takes.
template <int Count>
inline void column_products(const NodeMatrix& M, int node, const double* const* x, Four* sum) {
  constexpr int kSums = 4;
  const int begin = M.begin[node], end = M.begin[node + 1];
  Four part[kSums][Count] = {};
  // Rows ascend: only the last of them can be the last node.
  const int inner = end > begin && M.rows[end - 1] == M.nodes - 1 ? end - 1 : end;
  int k = begin;
  for (; k + kSums <= inner; k += kSums) {
#pragma GCC unroll 4
    for (int s = 0; s < kSums; ++s) {
      const std::ptrdiff_t at = 3 * static_cast<std::ptrdiff_t>(M.rows[k + s]);
#pragma GCC unroll 2
      for (int i = 0; i < Count; ++i) part[s][i] += M.values[k + s] * load_four(x[i] + at);
    }
  }
  for (; k < end; ++k) {
#pragma GCC unroll 2
    for (int i = 0; i < Count; ++i) {
      part[0][i] += M.values[k] * load_node(x[i], M.rows[k], M.nodes - 1);
    }
  }
#pragma GCC unroll 2
  for (int i = 0; i < Count; ++i) sum[i] = (part[0][i] + part[1][i]) + (part[2][i] + part[3][i]);
}

inline void multiply_nodes(const NodeMatrix& M, int first, int count, const double* x, double* y) {
  for (int node = first; node < first + count; ++node) {
    Four sum;
    column_products<1>(M, node, &x, &sum);
    store_node(y + 3 * static_cast<std::ptrdiff_t>(node), sum);
  }
}

/// sum_b += x y_b for three columns.
inline void add_outer(const Four& x, const double* y, Four* sum) {
#pragma GCC unroll 3
  for (int b = 0; b < 3; ++b) sum[b] += x * y[b];
}

template <bool Loads>
inline void couple_some(const NodeMatrix& M, int first, int count, const double* const* d_v_a,
                        const double* weights, double* load, NodeSums& sums) {
  Four sum[NodeSums::kColumns], weight[6];
  for (int c = 0; c < NodeSums::kColumns; ++c) sum[c] = load_four(sums.value + 4 * c);
  for (int c = 0; Loads && c < 6; ++c) weight[c] = load_four(weights + 4 * c);
  for (int node = first; node < first + count; ++node) {
    const std::ptrdiff_t at = 3 * static_cast<std::ptrdiff_t>(node);
    Four product[2];
    column_products<Loads ? 2 : 1>(M, node, d_v_a, product);
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i) add_outer(product[0], d_v_a[i] + at, sum + 3 * i);
    if (!Loads) continue;
    Four total = {load[at], load[at + 1], load[at + 2], 0.0};
#pragma GCC unroll 2
    for (int i = 0; i < 2; ++i) {
#pragma GCC unroll 3
      for (int c = 0; c < 3; ++c) total += weight[3 * i + c] * product[i][c];
    }
    store_node(load + at, total);
  }
  for (int c = 0; c < NodeSums::kColumns; ++c) store_four(sums.value + 4 * c, sum[c]);
}

inline void couple_nodes(const NodeMatrix& M, int first, int count, const double* const* d_v_a,
                         const double* weights, double* load, NodeSums& sums) {
  if (load != nullptr) {
    couple_some<true>(M, first, count, d_v_a, weights, load, sums);
  } else {
    couple_some<false>(M, first, count, d_v_a, weights, load, sums);
  }
}

inline void sum_moments(const double* places, int first, int count, const double* x,
                        NodeSums& sums) {
  Four sum[4];
  for (int c = 0; c < 4; ++c) sum[c] = load_four(sums.value + 4 * c);
  for (int node = first; node < first + count; ++node) {
    const Four own = load_node(x, node, first + count - 1);
    const double* p = places + 4 * static_cast<std::ptrdiff_t>(node);
#pragma GCC unroll 4
    for (int c = 0; c < 4; ++c) sum[c] += own * p[c];
  }
  for (int c = 0; c < 4; ++c) store_four(sums.value + 4 * c, sum[c]);
}

inline void subtract_motion(const double* places, int first, int count, const double* motion,
                            double* y) {
  Four column[4];
  for (int c = 0; c < 4; ++c) column[c] = load_four(motion + 4 * c);
  for (int node = first; node < first + count; ++node) {
    const double* p = places + 4 * static_cast<std::ptrdiff_t>(node);
    Four moved = column[0] * p[0];
#pragma GCC unroll 3
    for (int c = 1; c < 4; ++c) moved += column[c] * p[c];
    const Four before = load_node(y, node, first + count - 1);
    store_node(y + 3 * static_cast<std::ptrdiff_t>(node), before - moved);
  }
}

/// `Count` columns at a time.
template <int Lanes, int Count>
inline void add_some_columns(const double* columns, std::ptrdiff_t stride, const double* weights,
                             std::ptrdiff_t rows, double* y) {
  typedef double Register __attribute__((vector_size(8 * Lanes)));
  std::ptrdiff_t i = 0;
  for (; i + Lanes <= rows; i += Lanes) {
    Register sum, one;
    __builtin_memcpy(&sum, y + i, sizeof sum);
#pragma GCC unroll 4
    for (int c = 0; c < Count; ++c) {
      __builtin_memcpy(&one, columns + c * stride + i, sizeof one);
      sum += one * weights[c];
    }
    __builtin_memcpy(y + i, &sum, sizeof sum);
  }
  for (; i < rows; ++i) {
    double sum = y[i];
#pragma GCC unroll 4
    for (int c = 0; c < Count; ++c) sum += columns[c * stride + i] * weights[c];
    y[i] = sum;
  }
}

template <int Lanes>
inline void add_columns(const double* columns, std::ptrdiff_t stride, int num_columns,
                        const double* weights, std::ptrdiff_t rows, double* y) {
  int c = 0;
  for (; c + 4 <= num_columns; c += 4) {
    add_some_columns<Lanes, 4>(columns + c * stride, stride, weights + c, rows, y);
  }
  for (; c < num_columns; ++c) {
    add_some_columns<Lanes, 1>(columns + c * stride, stride, weights + c, rows, y);
  }
}

template <int Lanes>
constexpr NodeKernels node_kernels_of() {
  return {multiply_nodes, couple_nodes, sum_moments, subtract_motion, add_columns<Lanes>};
}

}  // namespace
}  // namespace buckens::linalg
