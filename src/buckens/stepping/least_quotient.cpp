// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/least_quotient.h"

#include "buckens/linalg/symmetric_eigen.h"

namespace buckens::stepping {

using linalg::Matrix;
using linalg::Vector;

namespace {

// Vectors whose mass beyond the others is below this fraction add nothing.
constexpr double kNothingNew = 1e-10;

}  // namespace

Vector least_combination(const Matrix& M, const Matrix& K) {
  const Vector scale = M.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const linalg::SymmetricEigen mass =
      linalg::symmetric_eigen(scale.asDiagonal() * M * scale.asDiagonal());
  const auto kept = (mass.values.array() > kNothingNew * mass.values.maxCoeff());
  const auto rank = static_cast<Eigen::Index>(kept.count());
  if (rank == 0) return Vector::Zero(M.rows());
  const Matrix T = scale.asDiagonal() * mass.vectors.rightCols(rank) *
                   mass.values.tail(rank).cwiseSqrt().cwiseInverse().asDiagonal();
  return T * linalg::symmetric_eigen(T.transpose() * K * T).vectors.col(0);
}

}  // namespace buckens::stepping
