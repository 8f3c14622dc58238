// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/free_modes.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Spectra/SymGEigsShiftSolver.h>
#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/body/sieve.h"
#include "buckens/linalg/sparse_cholesky.h"

namespace buckens::body {

using linalg::Matrix;
using linalg::SparseMatrix;
using linalg::Vector;

namespace {

constexpr Eigen::Index kDenseLimit = 600;

Matrix six_columns(const Matrix& Phi) {
  Matrix padded = Matrix::Zero(Phi.rows(), 6);
  padded.leftCols(Phi.cols()) = Phi;
  return padded;
}

/// Brings metres and radians to one scale; massless variables by their stiffness.
Vector variable_scale(const SparseMatrix& M, const SparseMatrix& K) {
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

/// Orthonormal columns Z with PᵀZ = 0, rigid motions without mass left out, too. Rows are scaled.
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
  Eigen::ColPivHouseholderQR<Matrix> qr(excluded);
  qr.setThreshold(1e-8);  // rounding leaves 1e-14, a motion without mass 1
  const Eigen::Index free = P.rows() - qr.rank();
  Matrix Z = Matrix::Zero(P.rows(), free);
  Z.bottomRows(free).setIdentity();
  return qr.householderQ().setLength(qr.rank()) * Z;
}

/// Few variables without mass: (M − ν K) x = 0 with ν = 1/ω², the massless motions at ν = 0.
FreeModes solve_with_massless(const Matrix& M, const Matrix& K) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> eigen(M, K);
  if (eigen.info() != Eigen::Success) {
    throw NumericalError(
        "free vibration: the body has motions with neither mass nor stiffness; give its nodes "
        "mass");
  }
  const Vector nu = eigen.eigenvalues().reverse();
  Eigen::Index count = 0;
  while (count < nu.size() && nu[count] > 1e-14 * nu[0]) ++count;
  FreeModes modes;
  modes.omega = nu.head(count).cwiseSqrt().cwiseInverse();
  modes.shapes = eigen.eigenvectors().rowwise().reverse().leftCols(count) *
                 modes.omega.asDiagonal();  // K-orthonormal → M-orthonormal
  return modes;
}

FreeModes dense_modes(const SparseMatrix& M, const SparseMatrix& K, const Matrix& Phi,
                      const Sieve& sieve) {
  const Vector scale = variable_scale(M, K);
  const Matrix Z = scale.asDiagonal() * complement(Phi, sieve, scale);
  const Matrix Mz = Z.transpose() * (M * Z);
  const Matrix Kz = Z.transpose() * (K * Z);
  FreeModes modes;
  const Eigen::LLT<Matrix> cholesky(Mz);
  if (cholesky.info() == Eigen::Success && cholesky.rcond() > 1e-12) {
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> eigen(Kz, Mz);
    modes.omega = eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt();
    modes.shapes = eigen.eigenvectors();
  } else {
    modes = solve_with_massless(Mz, Kz);
  }
  modes.shapes = (Z * modes.shapes).eval();
  return modes;
}

/// y = Y (K + μM)⁻¹ x in the shape that Spectra calls.
struct SievedInverse {
  using Scalar = double;
  const linalg::SparseCholesky* factor;
  const Sieve* sieve;

  Eigen::Index rows() const { return factor->size(); }
  Eigen::Index cols() const { return factor->size(); }
  void set_shift(double /*sigma*/) {}
  void perform_op(const double* x, double* y) const {
    Vector work = Eigen::Map<const Vector>(x, rows());
    factor->solve_in_place(work);
    sieve->apply(work);
    Eigen::Map<Vector>(y, rows()) = work;
  }
};

struct MassProduct {
  using Scalar = double;
  const SparseMatrix* M;

  Eigen::Index rows() const { return M->rows(); }
  Eigen::Index cols() const { return M->cols(); }
  void perform_op(const double* x, double* y) const {
    Eigen::Map<Vector>(y, rows()).noalias() = *M * Eigen::Map<const Vector>(x, rows());
  }
};

struct ShiftedFactor {
  double mu;
  std::unique_ptr<linalg::SparseCholesky> factor;
};

ShiftedFactor factorise(const SparseMatrix& M, const SparseMatrix& K, double mu) {
  return {mu, std::make_unique<linalg::SparseCholesky>(SparseMatrix(K + mu * M))};
}

/// Lowers μ from far above towards the lowest ω². Sieved inverse iteration with a shift μ ≫ ω₁²
/// damps the upper spectrum, so its Rayleigh quotient is the next shift.
ShiftedFactor find_shift(const SparseMatrix& M, const SparseMatrix& K, const Sieve& sieve,
                         const Vector& scale) {
  double highest = 0.0;
  for (Eigen::Index i = 0; i < M.rows(); ++i) {
    highest = std::max(highest, K.coeff(i, i) * scale[i] * scale[i]);
  }
  ShiftedFactor current = factorise(M, K, 1e-8 * highest);
  Vector x(M.rows());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    x[i] = scale[i] * std::sin(1.0 + static_cast<double>(i));  // any vector rich in all modes
  }
  for (int round = 0; round < 20; ++round) {
    double nu = 0.0;
    for (int sweep = 0; sweep < 4; ++sweep) {
      Vector y = M * x;
      const double size = std::sqrt(x.dot(y));
      current.factor->solve_in_place(y);
      sieve.apply(y);
      nu = std::sqrt(y.dot(M * y)) / size;
      x = y / y.norm();
    }
    const double lowest = 1.0 / nu - current.mu;
    if (lowest > 0.3 * current.mu) break;
    try {
      current = factorise(M, K, std::max(lowest, 0.01 * current.mu));
    } catch (const NumericalError&) {
      break;  // the shift drowns in rounding of K: the last one is the best there is
    }
  }
  return current;
}

FreeModes sparse_modes(const SparseMatrix& M, const SparseMatrix& K, const Sieve& sieve,
                       Eigen::Index count) {
  const ShiftedFactor shifted = find_shift(M, K, sieve, variable_scale(M, K));
  SievedInverse inverse{shifted.factor.get(), &sieve};
  MassProduct mass{&M};
  const Eigen::Index basis = std::min(M.rows(), std::max<Eigen::Index>(2 * count + 8, 24));
  Spectra::SymGEigsShiftSolver<SievedInverse, MassProduct, Spectra::GEigsMode::ShiftInvert> solver(
      inverse, mass, count, basis, -shifted.mu);
  solver.init();
  solver.compute(Spectra::SortRule::LargestMagn, 300, 1e-12, Spectra::SortRule::SmallestAlge);
  if (solver.info() != Spectra::CompInfo::Successful) {
    throw NumericalError(fmt::format(
        "free vibration: the {} lowest modes did not converge in 300 Lanczos restarts; ask for "
        "fewer modes",
        count));
  }
  return {solver.eigenvalues().cwiseMax(0.0).cwiseSqrt(), solver.eigenvectors()};
}

}  // namespace

FreeModes free_modes(const SparseMatrix& M, const SparseMatrix& K, const Matrix& Phi, int count) {
  const Sieve sieve(six_columns(Phi), M);
  const Eigen::Index elastic = M.rows() - sieve.rank();
  const Eigen::Index wanted = std::clamp<Eigen::Index>(count, 0, elastic);
  if (wanted == 0) return {Vector(0), Matrix(M.rows(), 0)};
  const bool dense = M.rows() <= kDenseLimit || 3 * wanted > M.rows();
  FreeModes modes = dense ? dense_modes(M, K, Phi, sieve) : sparse_modes(M, K, sieve, wanted);
  const Eigen::Index found = std::min(wanted, modes.omega.size());
  modes.omega = modes.omega.head(found).eval();
  modes.shapes = modes.shapes.leftCols(found).eval();
  return modes;
}

}  // namespace buckens::body
