// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/node_kernels.h"

#include <algorithm>
#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/linalg/inverse_iteration.h"

namespace buckens::linalg {
namespace {

using Eigen::Matrix3Xd;
using Eigen::Matrix4Xd;

constexpr int kNodes = 37;
// Sums of at most a hundred products of numbers near one, in another order.
constexpr double kRounding = 1e-14;

std::vector<SimdLevel> levels() {
  std::vector<SimdLevel> out;
  for (const SimdLevel level : {SimdLevel::portable, SimdLevel::avx2, SimdLevel::avx512}) {
    if (level <= best_simd_level()) out.push_back(level);
  }
  return out;
}

/// Symmetric, with rows of different lengths and a node without any entry.
SparseMatrix scalar_matrix() {
  std::vector<Triplet> entries;
  for (int j = 0; j < kNodes; ++j) {
    if (j == 5) continue;
    for (int i = j; i < std::min(kNodes, j + 1 + j % 4); ++i) {
      if (i == 5) continue;
      const double value = 1.0 / (1 + i + 2 * j);
      entries.emplace_back(i, j, value);
      if (i != j) entries.emplace_back(j, i, value);
    }
  }
  SparseMatrix out(kNodes, kNodes);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

NodeMatrix view(const SparseMatrix& A) {
  return {A.valuePtr(), A.innerIndexPtr(), A.outerIndexPtr(), static_cast<int>(A.cols())};
}

/// Of exactly its size, so that reading past its end is found by the address sanitizer.
Matrix3Xd vectors(unsigned seed) {
  const Vector x = scattered_block(3 * kNodes, 1, seed);
  return Eigen::Map<const Matrix3Xd>(x.data(), 3, kNodes);
}

Matrix4Xd places() {
  Matrix4Xd out(4, kNodes);
  out.topRows<3>() = vectors(9);
  out.row(3).setLinSpaced(0.5, 2.0);
  return out;
}

TEST(NodeKernels, MultiplyByTheScalarMatrix) {
  const SparseMatrix A = scalar_matrix();
  const Matrix3Xd x = vectors(1);
  const Matrix3Xd expected = x * A;
  for (const SimdLevel level : levels()) {
    Matrix3Xd y = Matrix3Xd::Constant(3, kNodes, 7.0), pieces = y;
    const NodeKernels& kernels = node_kernels(level);
    kernels.multiply(view(A), 0, kNodes, x.data(), y.data());
    EXPECT_LE((y - expected).norm(), kRounding) << to_string(level);
    for (int node = 0; node < kNodes; node += 5) {
      kernels.multiply(view(A), node, std::min(5, kNodes - node), x.data(), pieces.data());
    }
    EXPECT_EQ(pieces, y) << to_string(level);
  }
}

TEST(NodeKernels, CoupleThreeVectors) {
  const SparseMatrix A = scalar_matrix();
  const Matrix3Xd d = vectors(1), v = vectors(2), a = vectors(3), before = vectors(4);
  const Eigen::Matrix3d with_d = vectors(5).leftCols<3>(), with_rate = vectors(6).leftCols<3>();
  Eigen::Matrix<double, 4, 6> weights = Eigen::Matrix<double, 4, 6>::Zero();
  weights.topRows<3>() << with_d, with_rate;
  const Matrix3Xd load = before + with_d * d * A + with_rate * v * A;
  const std::array<const double*, 3> all = {d.data(), v.data(), a.data()};
  for (const SimdLevel level : levels()) {
    for (const bool loads : {false, true}) {
      NodeSums sums;
      Matrix3Xd out = before;
      for (const int first : {0, 20}) {
        node_kernels(level).couple(view(A), first, first == 0 ? 20 : kNodes - 20, all.data(),
                                   weights.data(), loads ? out.data() : nullptr, sums);
      }
      const Eigen::Map<const Eigen::Matrix<double, 4, 9>> sum(sums.value);
      EXPECT_LE((sum.block<3, 3>(0, 0) - d * A * d.transpose()).norm(), kRounding);
      EXPECT_LE((sum.block<3, 3>(0, 3) - d * A * v.transpose()).norm(), kRounding);
      EXPECT_LE((sum.block<3, 3>(0, 6) - d * A * a.transpose()).norm(), kRounding);
      EXPECT_LE((out - (loads ? load : before)).norm(), kRounding) << to_string(level);
    }
  }
}

TEST(NodeKernels, SumMomentsAndSubtractMotion) {
  const Matrix3Xd x = vectors(1);
  const Matrix4Xd p = places();
  Eigen::Matrix4d motion = Eigen::Matrix4d::Zero();
  motion.topRows<3>() = vectors(2).leftCols<4>();
  for (const SimdLevel level : levels()) {
    NodeSums sums;
    Matrix3Xd y = x;
    for (const int first : {0, 11}) {
      const int count = first == 0 ? 11 : kNodes - 11;
      node_kernels(level).moments(p.data(), first, count, x.data(), sums);
      node_kernels(level).subtract(p.data(), first, count, motion.data(), y.data());
    }
    const Eigen::Map<const Eigen::Matrix4d> sum(sums.value);
    EXPECT_LE((sum.topRows<3>() - x * p.transpose()).norm(), 10 * kRounding) << to_string(level);
    EXPECT_LE((y - (x - motion.topRows<3>() * p)).norm(), kRounding) << to_string(level);
  }
}

TEST(NodeKernels, AddColumns) {
  constexpr int kRows = 61;
  for (const SimdLevel level : levels()) {
    for (const int count : {1, 3, 4, 7, 8}) {
      const Matrix columns = scattered_block(kRows, count, 3);
      const Vector weights = Vector::LinSpaced(count, -1.0, 2.0);
      Vector y = Vector::Ones(kRows);
      node_kernels(level).add_columns(columns.data(), kRows, count, weights.data(), kRows,
                                      y.data());
      EXPECT_LE((y - Vector::Ones(kRows) - columns * weights).norm(), kRounding)
          << to_string(level) << ' ' << count;
    }
  }
}

}  // namespace
}  // namespace buckens::linalg
