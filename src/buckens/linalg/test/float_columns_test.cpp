// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/float_columns.h"

#include <gtest/gtest.h>

#include "buckens/linalg/matrix_types.h"

namespace buckens::linalg {
namespace {

/// Any numbers of rows and columns, also those that are no multiple of what is done together.
TEST(FloatColumns, GiveProductsAndSumsInDoublePrecision) {
  constexpr int kStride = 13;
  const Eigen::MatrixXf all = Eigen::MatrixXf::Random(kStride, 10);
  for (int rows = 0; rows <= kStride; ++rows) {
    for (int count = 0; count <= 10; ++count) {
      const Matrix columns = all.topLeftCorner(rows, count).cast<double>();
      const FloatColumns found{all.data(), kStride, rows, count};
      const Vector x = Vector::Random(rows), weights = Vector::Random(count);
      Vector products = Vector::Constant(count, 7.0);
      found.products(x.data(), products.data());
      // Of at most 13 terms of at most 1, rounded in double precision.
      EXPECT_LE((products - columns.transpose() * x).lpNorm<Eigen::Infinity>(), 1e-14)
          << rows << " " << count;
      Vector y = x;
      found.add_to(-2.0, weights.data(), y.data());
      EXPECT_LE((y - (x - 2.0 * columns * weights)).lpNorm<Eigen::Infinity>(), 1e-13)
          << rows << " " << count;
    }
  }
}

}  // namespace
}  // namespace buckens::linalg
