// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <vector>

#include <Eigen/Dense>

#include "buckens/linalg/inverse_iteration.h"
#include "buckens/linalg/matrix_types.h"

namespace buckens::linalg::matrices {

/// Like a solid mesh: n³ nodes with three variables each, coupled with all 26 neighbours, and some
/// mass.
inline SparseMatrix grid(int n, double mass) {
  std::vector<Triplet> entries;
  const auto node = [n](int i, int j, int k) { return i + n * (j + n * k); };
  const auto couple = [&](int a, int b, const Eigen::Vector3d& e) {
    const Eigen::Matrix3d block = e * e.transpose() + 0.1 * Eigen::Matrix3d::Identity();
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) {
        entries.emplace_back(3 * a + r, 3 * a + c, block(r, c));
        entries.emplace_back(3 * b + r, 3 * b + c, block(r, c));
        entries.emplace_back(3 * a + r, 3 * b + c, -block(r, c));
        entries.emplace_back(3 * b + r, 3 * a + c, -block(r, c));
      }
    }
  };
  for (int place = 0; place < n * n * n; ++place) {
    const int i = place % n, j = place / n % n, k = place / (n * n);
    for (int to = 14; to < 27; ++to) {  // the later half of the neighbours
      const int di = to % 3 - 1, dj = to / 3 % 3 - 1, dk = to / 9 - 1;
      if (i + di < 0 || i + di >= n || j + dj < 0 || j + dj >= n || k + dk >= n) continue;
      couple(place, node(i + di, j + dj, k + dk), Eigen::Vector3d(di, dj, dk).normalized());
    }
    for (int r = 0; r < 3; ++r) entries.emplace_back(3 * place + r, 3 * place + r, mass);
  }
  SparseMatrix A(3 * n * n * n, 3 * n * n * n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

/// Random pattern, diagonally dominant by a little.
inline SparseMatrix random_definite(int n, int per_row) {
  const Matrix numbers = scattered_block(n, 2 * per_row, 7);
  std::vector<Triplet> entries;
  Vector diagonal = Vector::Constant(n, 0.01);
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < per_row; ++k) {
      const int j = static_cast<int>(0.5 * (numbers(i, 2 * k) + 1.0) * n);
      const double value = numbers(i, 2 * k + 1);
      if (i == j) continue;
      entries.emplace_back(i, j, value);
      entries.emplace_back(j, i, value);
      diagonal[i] += std::abs(value);
      diagonal[j] += std::abs(value);
    }
  }
  for (int i = 0; i < n; ++i) entries.emplace_back(i, i, diagonal[i]);
  SparseMatrix A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

inline SparseMatrix dense_definite(int n) {
  const Matrix R = scattered_block(n, n, 5);
  return Matrix(R * R.transpose() + 0.1 * Matrix::Identity(n, n)).sparseView();
}

inline SparseMatrix diagonal(int n) {
  SparseMatrix A(n, n);
  for (int k = 0; k < n; ++k) A.insert(k, k) = 1.0 + k;
  return A;
}

}  // namespace buckens::linalg::matrices
