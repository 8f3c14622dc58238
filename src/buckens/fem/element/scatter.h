// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "buckens/fem/element/block.h"
#include "buckens/fem/element/shape_polynomial.h"

namespace buckens::fem {

/// Adds `scale` times an element matrix to the triplets of a body matrix. DOF −1 are dropped, as
/// planar models need; exact zeros are left out, so axis-aligned beams stay decoupled.
template <int N>
void scatter(const Eigen::Matrix<double, N, N>& element, const std::array<int, N>& dofs,
             double scale, std::vector<linalg::Triplet>& sum) {
  for (int j = 0; j < N; ++j) {
    const int column = dofs[static_cast<std::size_t>(j)];
    if (column < 0) continue;
    for (int i = 0; i < N; ++i) {
      const int row = dofs[static_cast<std::size_t>(i)];
      if (row >= 0 && element(i, j) != 0.0) sum.emplace_back(row, column, scale * element(i, j));
    }
  }
}

/// Adds `scale` times an element matrix; indices −1 and exact zeros are left out.
inline void scatter_square(const Eigen::Ref<const linalg::Matrix>& element,
                           std::span<const int> numbers, double scale,
                           std::vector<linalg::Triplet>& sum) {
  for (Eigen::Index j = 0; j < element.cols(); ++j) {
    const int column = numbers[static_cast<std::size_t>(j)];
    for (Eigen::Index i = 0; column >= 0 && i < element.rows(); ++i) {
      const int row = numbers[static_cast<std::size_t>(i)];
      if (row >= 0 && element(i, j) != 0.0) sum.emplace_back(row, column, scale * element(i, j));
    }
  }
}

/// Adds the inertia of one element to that of the body.
template <int N>
void scatter(const ElementInertia<N>& element, const std::array<int, N>& dofs, InertiaSum& sum) {
  for (std::size_t k = 0; k < element.W.size(); ++k) scatter<N>(element.W[k], dofs, 1.0, sum.W[k]);
  for (int i = 0; i < N; ++i) {
    const int row = dofs[static_cast<std::size_t>(i)];
    if (row >= 0) sum.c.row(row) += element.c.row(i);
  }
  sum.C0 += element.C0;
}

/// Adds the rows of a 3×N map to those of a point.
template <int N>
void scatter(const Eigen::Matrix<double, 3, N>& map, const std::array<int, N>& dofs,
             std::vector<linalg::Triplet>& rows) {
  for (int j = 0; j < N; ++j) {
    const int column = dofs[static_cast<std::size_t>(j)];
    if (column < 0) continue;
    for (int i = 0; i < 3; ++i) {
      if (map(i, j) != 0.0) rows.emplace_back(i, column, map(i, j));
    }
  }
}

}  // namespace buckens::fem
