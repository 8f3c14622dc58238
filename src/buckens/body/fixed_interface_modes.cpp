// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/fixed_interface_modes.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/body/dense_free_modes.h"
#include "buckens/body/iterated_modes.h"
#include "buckens/body/shift_estimate.h"
#include "buckens/linalg/inverse_iteration.h"
#include "buckens/linalg/pivoted_qr.h"
#include "buckens/linalg/pseudo_inverse.h"
#include "buckens/linalg/ranks.h"
#include "buckens/linalg/symmetric_eigen.h"

namespace buckens::body {

using linalg::Matrix;
using linalg::SparseMatrix;
using linalg::Vector;

namespace {

// Dependent rows leave 1e-16, others rarely less than 1e-4.
constexpr double kDependentColumn = 1e-10;
constexpr double kModeTolerance = 1e-9;

Matrix interface_columns(const FlexiblePart& part) {
  const SparseMatrix N = part.rows.topRows(part.num_held_rows());
  return Matrix(SparseMatrix(N.transpose()));
}

/// Orthonormal columns Z with N Z = 0; variables are scaled.
Matrix null_space(const Matrix& columns, const Vector& scale) {
  Matrix weighted = scale.asDiagonal() * columns;
  for (Eigen::Index k = 0; k < weighted.cols(); ++k) {
    const double size = weighted.col(k).norm();
    if (size > 0.0) weighted.col(k) /= size;
  }
  return linalg::PivotedQr(weighted, kDependentColumn).complement();
}

FreeModes solve_fixed_dense(const FlexiblePart& part, const Matrix& columns, Eigen::Index count) {
  const Vector scale = variable_scale(part.fe.M, part.fe.K);
  const Matrix Z = scale.asDiagonal() * null_space(columns, scale);
  // Few variables without mass: with a shift, the roles of M and K can be exchanged.
  const double shift = 1e-6 * highest_square(part.fe.M, part.fe.K);
  const Matrix M = Z.transpose() * (part.fe.M * Z);
  const Matrix A = Z.transpose() * (part.fe.K * Z) + shift * M;
  const std::optional<linalg::SymmetricEigen> eigen = linalg::generalised_eigen(M, A);
  if (!eigen) {
    throw NumericalError(
        "vibrations with held interfaces: the body has motions with neither mass nor stiffness; "
        "give its nodes mass");
  }
  const Vector theta = eigen->values.reverse();
  Eigen::Index found = 0;
  while (found < std::min(count, theta.size()) && theta[found] > 1e-14 * theta[0]) ++found;
  FreeModes out;
  out.omega = (theta.head(found).cwiseInverse().array() - shift).max(0.0).sqrt().matrix();
  out.shapes = Z * eigen->vectors.rowwise().reverse().leftCols(found) *
               theta.head(found).cwiseSqrt().cwiseInverse().asDiagonal();
  return out;
}

FreeModes iterate_fixed(const FlexiblePart& part, const Matrix& columns, int count) {
  const linalg::SymmetricMatrix& M = part.fe.M;
  const double bound = lowest_square_estimate(part);
  const double shift = bound > 0.0 ? 0.3 * bound : cautious_shift(M, part.fe.K);
  const auto factor = linalg::make_large_factor(shifted(part.fe.K, shift, M));
  const Matrix G = factor->solve(columns);
  linalg::PseudoInverse stiffness;
  stiffness.compute(columns.transpose() * G);
  const auto inverse = [&](Matrix& F) {
    F = factor->solve(F);
    F -= G * (stiffness * Matrix(columns.transpose() * F));
  };
  linalg::InverseIterationSettings settings;
  settings.count = count;
  settings.tolerance = kModeTolerance;
  const linalg::InversePairs pairs =
      linalg::largest_inverse_pairs(M, inverse, Matrix(M.rows(), 0), settings);
  if (!pairs.is_complete) {
    throw NumericalError(
        fmt::format("vibrations with held interfaces: the {} lowest did not converge in {} sweeps; "
                    "ask for fewer modes",
                    count, pairs.sweeps));
  }
  return {(pairs.theta.cwiseInverse().array() - shift).max(0.0).sqrt().matrix(), pairs.shapes};
}

}  // namespace

FreeModes fixed_interface_modes(const FlexiblePart& part, int count) {
  const Matrix columns = interface_columns(part);
  const Eigen::Index most = part.num_dofs();
  const Eigen::Index wanted = std::clamp<Eigen::Index>(count, 0, most);
  if (wanted == 0) return {Vector(0), Matrix(part.num_dofs(), 0)};
  refuse_too_many_modes(part.num_dofs(), wanted);
  if (is_dense_better(part.num_dofs(), wanted)) return solve_fixed_dense(part, columns, wanted);
  return iterate_fixed(part, columns, static_cast<int>(wanted));
}

}  // namespace buckens::body
