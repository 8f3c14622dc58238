// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/float_columns.h"

#include <array>

namespace buckens::linalg {

namespace {

// Columns that share the numbers of a vector while these are in registers, and sums of each that do
// not wait for each other.
constexpr int kTogether = 4;
constexpr int kSums = 4;

}  // namespace

void FloatColumns::products(const double* x, double* out) const {
  int k = 0;
  for (; k + kTogether <= count; k += kTogether) {
    const float* c = values + k * stride;
    std::array<std::array<double, kSums>, kTogether> sums{};
    std::ptrdiff_t row = 0;
    for (; row + kSums <= rows; row += kSums) {
      for (int s = 0; s < kSums; ++s) {
        const double of_x = x[row + s];
        for (int j = 0; j < kTogether; ++j) {
          sums[static_cast<std::size_t>(j)][static_cast<std::size_t>(s)] +=
              static_cast<double>(c[j * stride + row + s]) * of_x;
        }
      }
    }
    for (; row < rows; ++row) {
      for (int j = 0; j < kTogether; ++j) {
        sums[static_cast<std::size_t>(j)][0] += static_cast<double>(c[j * stride + row]) * x[row];
      }
    }
    for (int j = 0; j < kTogether; ++j) {
      const auto& of_column = sums[static_cast<std::size_t>(j)];
      out[k + j] = (of_column[0] + of_column[2]) + (of_column[1] + of_column[3]);
    }
  }
  for (; k < count; ++k) {
    const float* c = values + k * stride;
    double sum = 0;
    for (std::ptrdiff_t row = 0; row < rows; ++row) sum += static_cast<double>(c[row]) * x[row];
    out[k] = sum;
  }
}

void FloatColumns::add_to(double factor, const double* weights, double* y) const {
  int k = 0;
  for (; k + kTogether <= count; k += kTogether) {
    const float* a = values + k * stride;
    const float *b = a + stride, *c = b + stride, *d = c + stride;
    const double w = factor * weights[k], x = factor * weights[k + 1];
    const double v = factor * weights[k + 2], u = factor * weights[k + 3];
    for (std::ptrdiff_t row = 0; row < rows; ++row) {
      y[row] += (w * static_cast<double>(a[row]) + x * static_cast<double>(b[row])) +
                (v * static_cast<double>(c[row]) + u * static_cast<double>(d[row]));
    }
  }
  for (; k < count; ++k) {
    const float* a = values + k * stride;
    const double w = factor * weights[k];
    for (std::ptrdiff_t row = 0; row < rows; ++row) y[row] += w * static_cast<double>(a[row]);
  }
}

}  // namespace buckens::linalg
