// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/reduction.h"

#include <cmath>
#include <utility>

#include <Eigen/Eigenvalues>

#include "buckens/body/elastic_inverse.h"
#include "buckens/body/free_modes.h"

namespace buckens::body {

using linalg::Matrix;
using linalg::SparseMatrix;
using linalg::Vector;

namespace {

// Residuals whose mass is below this share of the largest follow from the others and the modes:
// rounding leaves 1e-16 · (ω/ω₁)², a real one some 1e-6.
constexpr double kDependent = 1e-11;
// Rounding of the sieve leaves 1e-15.
constexpr double kStraining = 1e-9;

/// M-orthonormal basis of the span of the columns, dependent ones left out.
Matrix orthonormalised(const SparseMatrix& M, const Matrix& columns) {
  if (columns.cols() == 0) return columns;
  const Vector size = (columns.transpose() * (M * columns)).diagonal().cwiseMax(0.0).cwiseSqrt();
  Matrix scaled = columns;
  for (Eigen::Index k = 0; k < size.size(); ++k) {
    if (size[k] > 0.0) scaled.col(k) /= size[k];
  }
  const Matrix gram = scaled.transpose() * (M * scaled);
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(gram);
  Matrix out(columns.rows(), 0);
  for (Eigen::Index k = gram.cols() - 1; k >= 0; --k) {
    if (eigen.eigenvalues()[k] < kDependent) break;
    out.conservativeResize(Eigen::NoChange, out.cols() + 1);
    out.rightCols<1>() = scaled * eigen.eigenvectors().col(k) / std::sqrt(eigen.eigenvalues()[k]);
  }
  return out;
}

/// Unit loads on the interface rows, Nᵀ.
Matrix interface_loads(const FlexiblePart& part) {
  const SparseMatrix N = part.rows.topRows(part.num_interface_rows);
  return Matrix(SparseMatrix(N.transpose()));
}

/// The loads that do more than accelerate the body as a whole: those whose sieved part is not
/// rounding.
Matrix straining(const FlexiblePart& part, const Matrix& loads) {
  const Vector weight = part.fe.K.diagonal().unaryExpr(
      [](double stiffness) { return stiffness > 0.0 ? 1.0 / std::sqrt(stiffness) : 0.0; });
  Matrix kept(loads.rows(), 0);
  for (Eigen::Index k = 0; k < loads.cols(); ++k) {
    Vector sieved = loads.col(k);
    part.sieve.apply_transposed(sieved);
    const double whole = weight.cwiseProduct(loads.col(k)).norm();
    if (!(weight.cwiseProduct(sieved).norm() > kStraining * whole)) continue;
    kept.conservativeResize(Eigen::NoChange, kept.cols() + 1);
    kept.rightCols<1>() = sieved;
  }
  return kept;
}

/// What loads deform beyond the modes: (1 − φφᵀM) K⁺f, M-orthonormal.
Matrix residuals(const std::string& body, const FlexiblePart& part, const Matrix& modes,
                 const Matrix& all_loads, double length) {
  const SparseMatrix& M = part.fe.M;
  const Matrix loads = straining(part, all_loads);
  if (loads.cols() == 0) return Matrix(M.rows(), 0);
  const ElasticInverse inverse(body, part.fe, part.sieve, length);
  Matrix shapes = inverse.solve_checked(loads);
  const Vector whole = (shapes.transpose() * (M * shapes)).diagonal();
  // Twice, so that what is left is orthogonal to rounding.
  for (int pass = 0; pass < 2; ++pass) shapes -= modes * (modes.transpose() * (M * shapes));
  const Vector left = (shapes.transpose() * (M * shapes)).diagonal();
  Matrix kept(shapes.rows(), 0);
  for (Eigen::Index k = 0; k < shapes.cols(); ++k) {
    if (!(left[k] > kDependent * whole[k])) continue;
    kept.conservativeResize(Eigen::NoChange, kept.cols() + 1);
    kept.rightCols<1>() = shapes.col(k);
  }
  return orthonormalised(M, kept);
}

SparseMatrix diagonal(const Vector& entries) {
  SparseMatrix out(entries.size(), entries.size());
  for (Eigen::Index k = 0; k < entries.size(); ++k) out.insert(k, k) = entries[k];
  out.makeCompressed();
  return out;
}

/// ZᵀAZ; what is diagonal but for rounding becomes diagonal.
SparseMatrix projected(const SparseMatrix& A, const Matrix& Z) {
  const Matrix full = Z.transpose() * (A * Z);
  const Vector size = full.diagonal().cwiseAbs().cwiseSqrt();
  std::vector<linalg::Triplet> entries;
  for (Eigen::Index j = 0; j < full.cols(); ++j) {
    for (Eigen::Index i = 0; i < full.rows(); ++i) {
      if (i != j && std::abs(full(i, j)) <= 1e-12 * size[i] * size[j]) continue;
      if (full(i, j) != 0.0) {
        entries.emplace_back(static_cast<int>(i), static_cast<int>(j), full(i, j));
      }
    }
  }
  SparseMatrix out(full.rows(), full.cols());
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

fem::ShapeIntegrals projected(const FlexiblePart& part, const Matrix& Z) {
  constexpr int kPairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
  const fem::ShapeIntegrals& full = part.fe.shape;
  fem::ShapeIntegrals out;
  out.mass = full.mass;
  out.com = full.com;
  out.C0 = full.C0;
  out.J0 = full.J0;
  out.c = Z.transpose() * full.c;
  for (std::size_t k = 0; k < out.W.size(); ++k) {
    Eigen::Matrix3d pair = Eigen::Matrix3d::Zero();
    pair(kPairs[k][0], kPairs[k][1]) = 1.0;
    Matrix WZ = Matrix::Zero(Z.rows(), Z.cols());
    for (Eigen::Index j = 0; j < Z.cols(); ++j) {
      Vector column = Vector::Zero(Z.rows());
      part.invariants.add_weighted(pair, Z.col(j), column);
      WZ.col(j) = column;
    }
    out.W[k] = Matrix(Z.transpose() * WZ).sparseView();
  }
  return out;
}

Matrix beside(const Matrix& left, const Matrix& right) {
  Matrix out(left.rows(), left.cols() + right.cols());
  out << left, right;
  return out;
}

/// Brings the columns to ZᵀMZ = 1 and ZᵀKZ = diag(ω²).
void diagonalise(const FlexiblePart& part, const Matrix& columns, ReducedBasis& out) {
  const Matrix K = columns.transpose() * (part.fe.K * columns);
  const Matrix M = columns.transpose() * (part.fe.M * columns);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> eigen(0.5 * (K + K.transpose()),
                                                               0.5 * (M + M.transpose()));
  out.omega = eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  out.Z = columns * eigen.eigenvectors();
  out.num_residuals = static_cast<int>(columns.cols()) - out.num_modes;
}

/// Takes all inertia of its own from a deformation.
void drop_rates(fem::FeModel& fe) {
  fe.M.setZero();
  fe.K_damping.setZero();
  fe.mass_damping = 0;
  for (std::size_t k = 3; k < fe.shape.W.size(); ++k) {
    const SparseMatrix transposed = fe.shape.W[k].transpose();
    fe.shape.W[k] = 0.5 * (fe.shape.W[k] + transposed);
  }
}

}  // namespace

ReducedBasis free_free_basis(const std::string& body, const FlexiblePart& part, int modes,
                             bool static_correction, double length) {
  const FreeModes free = free_modes(part.fe.M, part.fe.K, part.sieve.Phi(), modes);
  ReducedBasis out;
  out.num_modes = static_cast<int>(free.omega.size());
  Matrix columns = free.shapes;
  if (static_correction && part.num_interface_rows > 0 && free.omega.size() > 0) {
    columns =
        beside(free.shapes, residuals(body, part, free.shapes, interface_loads(part), length));
  }
  diagonalise(part, columns, out);
  return out;
}

ReducedBasis quasi_static_basis(const std::string& body, const FlexiblePart& part, int modes,
                                double length) {
  ReducedBasis out;
  Matrix shapes(part.num_dofs(), 0);
  if (modes > 0) {
    shapes = free_modes(part.fe.M, part.fe.K, part.sieve.Phi(), modes).shapes;
    out.num_modes = static_cast<int>(shapes.cols());
  }
  const Matrix loads = beside(interface_loads(part), part.invariants.centrifugal_patterns());
  diagonalise(part, beside(shapes, residuals(body, part, shapes, loads, length)), out);
  return out;
}

std::unique_ptr<FlexiblePart> reduce(const std::string& body, const FlexiblePart& part,
                                     const ReducedBasis& basis) {
  const Matrix& Z = basis.Z;
  fem::FeModel fe;
  fe.nodes = part.mesh().nodes;
  fe.dofs.num_dofs = static_cast<int>(Z.cols());
  std::array<int, 6> none{};
  none.fill(-1);
  fe.dofs.node_dofs.assign(fe.nodes.size(), none);  // no coordinate belongs to a node
  fe.M = diagonal(Vector::Ones(Z.cols()));
  fe.K = diagonal(basis.omega.cwiseAbs2());
  fe.K_damping = projected(part.fe.K_damping, Z);
  fe.mass_damping = part.fe.mass_damping;
  fe.shape = projected(part, Z);
  if (part.is_quasi_static) drop_rates(fe);
  auto out = std::make_unique<FlexiblePart>(body, std::move(fe), part.coupling);
  out->is_quasi_static = part.is_quasi_static;
  out->full_mesh = part.full_mesh ? part.full_mesh : std::make_shared<const fem::FeModel>(part.fe);
  out->recovery = part.recovery.of(Z);
  out->rows = Matrix(part.rows * Z).sparseView();
  out->num_interface_rows = part.num_interface_rows;
  return out;
}

}  // namespace buckens::body
