// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/free_modes.h"

#include <algorithm>

#include "buckens/body/dense_free_modes.h"
#include "buckens/body/iterated_modes.h"
#include "buckens/body/sieve.h"
#include "buckens/linalg/ranks.h"

namespace buckens::body {

using linalg::Matrix;
using linalg::SymmetricMatrix;
using linalg::Vector;

namespace {

constexpr Eigen::Index kDenseLimit = 600;
constexpr double kTolerance = 1e-9;

Matrix six_columns(const Matrix& Phi) {
  Matrix padded = Matrix::Zero(Phi.rows(), 6);
  padded.leftCols(Phi.cols()) = Phi;
  return padded;
}

}  // namespace

bool is_dense_better(Eigen::Index num_dofs, Eigen::Index count) {
  return num_dofs <= kDenseLimit || 3 * count > num_dofs;
}

FreeModes free_modes(const SymmetricMatrix& M, const SymmetricMatrix& K, const Matrix& Phi,
                     int count) {
  const Sieve sieve(six_columns(Phi), M);
  const Eigen::Index elastic = M.rows() - sieve.rank();
  const Eigen::Index wanted = std::clamp<Eigen::Index>(count, 0, elastic);
  if (wanted == 0) return {Vector(0), Matrix(M.rows(), 0)};
  refuse_too_many_modes(M.rows(), wanted);
  FreeModes modes;
  if (is_dense_better(M.rows(), wanted)) {
    modes = dense_free_modes(M, K, Phi, sieve);
  } else {
    modes = iterate_with_shift(M, K, sieve, cautious_shift(M, K), static_cast<int>(wanted),
                               kTolerance, linalg::make_large_factor)
                .modes;
  }
  const Eigen::Index found = std::min(wanted, modes.omega.size());
  modes.omega = modes.omega.head(found).eval();
  modes.shapes = modes.shapes.leftCols(found).eval();
  return modes;
}

}  // namespace buckens::body
