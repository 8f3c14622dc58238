// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "buckens/stepping/strand/layout.h"

// All functions with arguments of this kind are inlined.
#pragma GCC diagnostic ignored "-Wpsabi"

// Included by the sources kernels_*.cpp only, each compiled for another instruction set. As
// in linalg/panel_kernels_impl.h, functions of the standard library must not be used here.
namespace buckens::stepping::strand {
namespace {

/// One number of every lane.
typedef double Lanes __attribute__((vector_size(8 * kLanes)));

#define BUCKENS_LANES __attribute__((always_inline)) inline

BUCKENS_LANES Lanes load(const double* rows, int row) {
  Lanes out;
  __builtin_memcpy(&out, rows + static_cast<std::ptrdiff_t>(kLanes) * row, sizeof out);
  return out;
}
BUCKENS_LANES void store(double* rows, int row, const Lanes& value) {
  __builtin_memcpy(rows + static_cast<std::ptrdiff_t>(kLanes) * row, &value, sizeof value);
}

/// K numbers of every lane.
template <int K>
struct Numbers {
  Lanes x[K];
  BUCKENS_LANES Lanes& operator[](int k) { return x[k]; }
  BUCKENS_LANES const Lanes& operator[](int k) const { return x[k]; }
};

template <int K>
BUCKENS_LANES Numbers<K> take(const double* rows, int row) {
  Numbers<K> out;
#pragma GCC unroll 16
  for (int k = 0; k < K; ++k) out[k] = load(rows, row + k);
  return out;
}
template <int K>
BUCKENS_LANES void give(double* rows, int row, const Numbers<K>& value) {
#pragma GCC unroll 16
  for (int k = 0; k < K; ++k) store(rows, row + k, value[k]);
}
template <int K>
BUCKENS_LANES void clear(double* rows, int row) {
#pragma GCC unroll 16
  for (int k = 0; k < K; ++k) store(rows, row + k, Lanes{});
}

template <int K>
BUCKENS_LANES Numbers<K> operator+(const Numbers<K>& a, const Numbers<K>& b) {
  Numbers<K> out;
#pragma GCC unroll 16
  for (int k = 0; k < K; ++k) out[k] = a[k] + b[k];
  return out;
}
template <int K>
BUCKENS_LANES Numbers<K> operator-(const Numbers<K>& a, const Numbers<K>& b) {
  Numbers<K> out;
#pragma GCC unroll 16
  for (int k = 0; k < K; ++k) out[k] = a[k] - b[k];
  return out;
}
template <int K>
BUCKENS_LANES Numbers<K> operator*(double factor, const Numbers<K>& a) {
  Numbers<K> out;
#pragma GCC unroll 16
  for (int k = 0; k < K; ++k) out[k] = factor * a[k];
  return out;
}
template <int K>
BUCKENS_LANES Numbers<K> scaled(const Lanes& factor, const Numbers<K>& a) {
  Numbers<K> out;
#pragma GCC unroll 16
  for (int k = 0; k < K; ++k) out[k] = factor * a[k];
  return out;
}
template <int K>
BUCKENS_LANES Lanes dot(const Numbers<K>& a, const Numbers<K>& b) {
  Lanes out = a[0] * b[0];
#pragma GCC unroll 16
  for (int k = 1; k < K; ++k) out += a[k] * b[k];
  return out;
}

BUCKENS_LANES Lanes absolute(const Lanes& a) { return a < 0.0 ? -a : a; }
/// The larger; NaN of b wins, and stays in a.
BUCKENS_LANES Lanes larger(const Lanes& a, const Lanes& b) {
  return (~(b <= a) & (a == a)) ? b : a;
}
BUCKENS_LANES double largest(const Lanes& a) {
  double out = a[0];
  for (int k = 1; k < kLanes; ++k) out = !(a[k] <= out) && out == out ? a[k] : out;
  return out;
}
template <int K>
BUCKENS_LANES Lanes largest_of(const Numbers<K>& a) {
  Lanes out = absolute(a[0]);
#pragma GCC unroll 16
  for (int k = 1; k < K; ++k) out = larger(out, absolute(a[k]));
  return out;
}

/// y = M x with M by rows in the table.
template <int Rows, int Columns>
BUCKENS_LANES Numbers<Rows> product(const double* rows, int M, const Numbers<Columns>& x) {
  Numbers<Rows> out;
  for (int r = 0; r < Rows; ++r) {
    Lanes sum = load(rows, M + Columns * r) * x[0];
#pragma GCC unroll 16
    for (int k = 1; k < Columns; ++k) sum += load(rows, M + Columns * r + k) * x[k];
    out[r] = sum;
  }
  return out;
}
/// y = Mᵀ x with M by rows in the table.
template <int Rows, int Columns>
BUCKENS_LANES Numbers<Columns> transposed_product(const double* rows, int M,
                                                  const Numbers<Rows>& x) {
  Numbers<Columns> out;
#pragma GCC unroll 16
  for (int k = 0; k < Columns; ++k) out[k] = load(rows, M + k) * x[0];
  for (int r = 1; r < Rows; ++r) {
#pragma GCC unroll 16
    for (int k = 0; k < Columns; ++k) out[k] += load(rows, M + Columns * r + k) * x[r];
  }
  return out;
}

/// The entries (I, K) … (I, I) of a symmetric matrix: to y_I what is left of its row, to y_K what
/// the other half has.
template <int I, int K, int N>
BUCKENS_LANES void add_symmetric_row(const double* rows, const Numbers<N>& x, Numbers<N>& y) {
  const Lanes entry = load(rows, symmetric_place(I, K));
  if constexpr (K < I) {
    y[K] += entry * x[I];
    y[I] += entry * x[K];
    add_symmetric_row<I, K + 1, N>(rows, x, y);
  } else {
    y[I] += entry * x[I];
    if constexpr (I + 1 < N) {
      y[I + 1] = load(rows, symmetric_place(I + 1, 0)) * x[0];
      y[0] += load(rows, symmetric_place(I + 1, 0)) * x[I + 1];
      add_symmetric_row<I + 1, 1, N>(rows, x, y);
    }
  }
}
/// y = M x with one half of a symmetric M in the table.
template <int N>
BUCKENS_LANES Numbers<N> symmetric_product(const double* rows, int M, const Numbers<N>& x) {
  const double* const half = rows + static_cast<std::ptrdiff_t>(kLanes) * M;
  Numbers<N> y;
  y[0] = load(half, 0) * x[0];
  y[1] = load(half, 1) * x[0];
  y[0] += load(half, 1) * x[1];
  add_symmetric_row<1, 1, N>(half, x, y);
  return y;
}

template <int K>
BUCKENS_LANES Numbers<K> combination(const Weights& w, const double* rows, int d, int rate,
                                     int accel, int alg) {
  Numbers<K> out;
#pragma GCC unroll 16
  for (int k = 0; k < K; ++k) {
    out[k] = w.rate * load(rows, rate + k) + w.accel * load(rows, accel + k) +
             w.alg * load(rows, alg + k);
    if (d >= 0) out[k] += w.d * load(rows, d + k);
  }
  return out;
}

}  // namespace
}  // namespace buckens::stepping::strand
