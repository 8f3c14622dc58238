// SPDX-License-Identifier: Apache-2.0
// Inertia integrals without zeros, as reduced bodies have them, against products written out.
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "buckens/body/deformation_coupling.h"
#include "buckens/body/second_moments.h"

namespace buckens::body {
namespace {

using Eigen::Matrix3d;
using linalg::Matrix;
using linalg::Vector;

Matrix numbers(Eigen::Index rows, Eigen::Index columns, double phase) {
  Matrix out(rows, columns);
  for (Eigen::Index j = 0; j < columns; ++j) {
    for (Eigen::Index i = 0; i < rows; ++i) {
      out(i, j) = std::sin(phase + 1.3 * static_cast<double>(i) + 0.7 * static_cast<double>(j * j));
    }
  }
  return out;
}

class DenseIntegrals : public testing::TestWithParam<int> {};

TEST_P(DenseIntegrals, GiveMomentsAndLoadsOfProductsWrittenOut) {
  const int n = GetParam();
  fem::ShapeIntegrals shape;
  std::array<std::array<Matrix, 3>, 3> W;
  for (std::size_t k = 0; k < kPairs.size(); ++k) {
    const auto a = static_cast<std::size_t>(kPairs[k][0]);
    const auto b = static_cast<std::size_t>(kPairs[k][1]);
    Matrix dense = numbers(n, n, static_cast<double>(k) + 0.7);  // no zero, which would be left out
    if (a == b) dense = (dense + dense.transpose()).eval();
    shape.W[k] = dense.sparseView(0.0, 0.0);
    shape.W[k].makeCompressed();
    ASSERT_EQ(shape.W[k].nonZeros(), n * n);
    W[a][b] = dense;
    W[b][a] = dense.transpose();
  }
  const Vector d = numbers(n, 1, 0.1), v = numbers(n, 1, 0.2), a = numbers(n, 1, 0.3);
  DeformationWeights weights;
  weights.with_d = numbers(3, 3, 0.4);
  weights.with_rate = numbers(3, 3, 0.5);
  Vector load = numbers(n, 1, 0.6);

  const Vector before = load;
  Vector expected = before;
  Matrix3d dd, dv, da;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Matrix& W_ij = W[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
      dd(i, j) = d.dot(W_ij * d);
      dv(i, j) = d.dot(W_ij * v);
      da(i, j) = d.dot(W_ij * a);
      expected += W_ij * (weights.with_d(i, j) * d + weights.with_rate(i, j) * v);
    }
  }
  const DeformedMoments moments = evaluate_deformation(shape, d, v, a, weights, load);
  // Sums of n² products of numbers below one.
  const double rounding = 1e-15 * n * n + 1e-14;
  EXPECT_LE((load - expected).cwiseAbs().maxCoeff(), 10 * rounding);
  EXPECT_LE((moments.J - to_inertia(dd)).cwiseAbs().maxCoeff(), 10 * rounding);
  EXPECT_LE((moments.J_dot - to_inertia(dv + dv.transpose())).cwiseAbs().maxCoeff(), 20 * rounding);
  EXPECT_LE((moments.l - axial(dv)).cwiseAbs().maxCoeff(), 10 * rounding);
  EXPECT_LE((moments.l_dot - axial(da)).cwiseAbs().maxCoeff(), 10 * rounding);

  // Whatever stood in a load that is overwritten does not count.
  Vector written = Vector::Constant(n, NAN);
  evaluate_deformation(shape, d, v, a, weights, written, nullptr, nullptr, true);
  EXPECT_LE((written - (expected - before)).cwiseAbs().maxCoeff(), 10 * rounding);

  // Without weights the load is not touched, the moments are the same.
  Vector untouched = expected;
  const DeformedMoments alone = evaluate_deformation(shape, d, v, a, {}, untouched);
  EXPECT_EQ((untouched - expected).norm(), 0.0);
  EXPECT_LE((alone.l - moments.l).cwiseAbs().maxCoeff(), 10 * rounding);
}

// A single mode, odd and even numbers, below and above a vector's lanes.
INSTANTIATE_TEST_SUITE_P(Modes, DenseIntegrals, testing::Values(1, 2, 3, 5, 8, 13, 32));

}  // namespace
}  // namespace buckens::body
