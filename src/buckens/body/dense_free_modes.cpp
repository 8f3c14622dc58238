// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/dense_free_modes.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/linalg/dense_cholesky.h"
#include "buckens/linalg/pivoted_qr.h"
#include "buckens/linalg/symmetric_eigen.h"

namespace buckens::body {

using linalg::Matrix;
using linalg::SymmetricMatrix;
using linalg::Vector;

namespace {

/// Orthonormal columns Z with PᵀZ = 0, also without massless rigid motions. Rows are scaled.
Matrix complement(const Matrix& Phi, const Sieve& sieve, const Vector& scale) {
  const Matrix P = scale.asDiagonal() * sieve.P();
  Matrix massless = Phi;
  sieve.apply(massless);
  Matrix excluded(P.rows(), P.cols() + Phi.cols());
  excluded << P.colwise().normalized(), scale.cwiseInverse().asDiagonal() * massless;
  for (Eigen::Index k = 0; k < Phi.cols(); ++k) {
    const double size = scale.cwiseInverse().cwiseProduct(Phi.col(k)).norm();
    if (size > 0.0) excluded.col(P.cols() + k) /= size;
  }
  if (excluded.cols() == 0) return Matrix::Identity(P.rows(), P.rows());
  // Rounding leaves 1e-14, a motion without mass 1.
  return linalg::PivotedQr(excluded, 1e-8).complement();
}

/// Few variables without mass: (M − ν K) x = 0 with ν = 1/ω², the massless motions at ν = 0.
FreeModes solve_with_massless(const Matrix& M, const Matrix& K) {
  const std::optional<linalg::SymmetricEigen> eigen = linalg::generalised_eigen(M, K);
  if (!eigen) {
    throw NumericalError(
        "free vibration: the body has motions with neither mass nor stiffness; give its nodes "
        "mass");
  }
  const Vector nu = eigen->values.reverse();
  Eigen::Index count = 0;
  while (count < nu.size() && nu[count] > 1e-14 * nu[0]) ++count;
  FreeModes modes;
  modes.omega = nu.head(count).cwiseSqrt().cwiseInverse();
  modes.shapes = eigen->vectors.rowwise().reverse().leftCols(count) *
                 modes.omega.asDiagonal();  // K-orthonormal → M-orthonormal
  return modes;
}

}  // namespace

void refuse_too_many_modes(Eigen::Index num_dofs, Eigen::Index count) {
  if (num_dofs <= kLargestDense || !is_dense_better(num_dofs, count)) return;
  throw ModelError(
      fmt::format("{} vibrations of a mesh of {} variables need full matrices, which are made for "
                  "up to {} variables; ask for at most {}, or for a lower cutoff",
                  count, num_dofs, kLargestDense, num_dofs / 4));
}

Vector variable_scale(const SymmetricMatrix& M, const SymmetricMatrix& K) {
  const Vector m = M.diagonal();
  const Vector k = K.diagonal();
  const double ratio = m.maxCoeff() / std::max(k.maxCoeff(), 1e-300);
  Vector scale(m.size());
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    const double size = m[i] > 0.0 ? m[i] : ratio * k[i];
    scale[i] = size > 0.0 ? 1.0 / std::sqrt(size) : 1.0;
  }
  return scale;
}

FreeModes dense_free_modes(const SymmetricMatrix& M, const SymmetricMatrix& K, const Matrix& Phi,
                           const Sieve& sieve) {
  const Vector scale = variable_scale(M, K);
  const Matrix Z = scale.asDiagonal() * complement(Phi, sieve, scale);
  const Matrix Mz = Z.transpose() * (M * Z);
  const Matrix Kz = Z.transpose() * (K * Z);
  FreeModes modes;
  const linalg::DenseCholesky cholesky(Mz);
  const bool is_regular = cholesky.is_positive_definite() && cholesky.rcond() > 1e-12;
  if (const auto eigen = is_regular ? linalg::generalised_eigen(Kz, Mz) : std::nullopt) {
    modes.omega = eigen->values.cwiseMax(0.0).cwiseSqrt();
    modes.shapes = eigen->vectors;
  } else {
    modes = solve_with_massless(Mz, Kz);
  }
  modes.shapes = (Z * modes.shapes).eval();
  return modes;
}

}  // namespace buckens::body
