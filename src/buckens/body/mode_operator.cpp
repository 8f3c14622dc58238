// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/mode_operator.h"

#include <cmath>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/allowed_threads.h"
#include "buckens/base/errors.h"
#include "buckens/linalg/dense_cholesky.h"
#include "buckens/linalg/dense_ldlt.h"
#include "buckens/linalg/matrix_sum.h"
#include "buckens/linalg/sparse_lu.h"
#include "buckens/linalg/tall_products.h"

namespace buckens::body {

using linalg::Matrix;
using linalg::SparseMatrix;
using linalg::SymmetricMatrix;
using linalg::Vector;

namespace {

constexpr Eigen::Index kFullPenalty = 1500;
constexpr double kMostEntries = 1.5e8;  // 1.2 GB of factor, 1.8 with its indices
constexpr int kPowerIterations = 20;
// Below, waking threads takes as long as they save.
constexpr Eigen::Index kManyVariables = 10000;

Vector unit_diagonal(const Vector& diagonal) {
  return diagonal.unaryExpr([](double a) { return a > 0.0 ? 1.0 / std::sqrt(a) : 1.0; });
}

/// [K −P; −Pᵀ 0] with P scaled to the size of K.
SparseMatrix bordered(const SparseMatrix& K, const Matrix& P) {
  std::vector<linalg::Triplet> entries;
  entries.reserve(static_cast<std::size_t>(K.nonZeros() + 2 * P.size()));
  for (int j = 0; j < K.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator it(K, j); it; ++it) {
      entries.emplace_back(static_cast<int>(it.row()), j, it.value());
    }
  }
  const int n = static_cast<int>(K.rows());
  for (int k = 0; k < static_cast<int>(P.cols()); ++k) {
    for (int i = 0; i < n; ++i) {
      if (P(i, k) == 0.0) continue;
      entries.emplace_back(i, n + k, -P(i, k));
      entries.emplace_back(n + k, i, -P(i, k));
    }
  }
  const int size = n + static_cast<int>(P.cols());
  SparseMatrix out(size, size);
  out.setFromTriplets(entries.begin(), entries.end());
  out.makeCompressed();
  return out;
}

/// (K + μM) x by one order where other processes have both.
Vector shifted_product(const SymmetricMatrix& K, double shift, const SymmetricMatrix& M,
                       const Vector& x) {
  Vector stiffness, mass;
  linalg::multiply({{&K, &x, &stiffness}, {&M, &x, &mass}});
  return stiffness + shift * mass;
}

double largest_by_power(const std::function<Vector(const Vector&)>& apply, Eigen::Index size) {
  Vector x = linalg::scattered_block(size, 1, 3);
  double norm = 0.0;
  for (int k = 0; k < kPowerIterations; ++k) {
    x /= x.norm();
    x = apply(x);
    norm = x.norm();
    if (!(norm > 0.0)) return 0.0;
  }
  return norm;
}

}  // namespace

linalg::MatrixSum shifted(const SymmetricMatrix& K, double shift, const SymmetricMatrix& M) {
  linalg::MatrixSum sum;
  sum.add(1.0, K);
  sum.add(shift, M);
  return sum;
}

ModeOperator sieved_operator(const SymmetricMatrix& M, const SymmetricMatrix& K, const Sieve& sieve,
                             double shift, const linalg::MakeFactor& make) {
  const linalg::MatrixSum A = shifted(K, shift, M);
  const auto factor = make(A);
  ModeOperator op;
  op.shift = shift;
  op.factor_entries = factor->num_factor_entries();
  if (M.rows() >= kManyVariables) op.pool = base::AllowedThreads::pool();
  // Yᵀ and Y commute with K + μM; both are applied so that rigid motion never grows to a size
  // that rounding cannot remove.
  const auto P = std::make_shared<const Matrix>(sieve.P());
  const auto Phi = std::make_shared<const Matrix>(sieve.Phi());
  op.inverse = [factor, P, Phi, pool = op.pool](Matrix& F) {
    const auto remove = [&](const Matrix& columns, const Matrix& rows) {
      const Matrix shares = linalg::inner_products(rows, F, pool);
      linalg::subtract_combinations(columns, shares, F, pool);
    };
    remove(*P, *Phi);
    factor->solve_in_place(F, pool);
    remove(*Phi, *P);
  };
  op.multiply = [&K, &M, shift](const Vector& x) { return shifted_product(K, shift, M, x); };
  op.solve = [factor](const Vector& b) -> Vector {
    Vector x = b;
    factor->solve_in_place(x);
    return x;
  };
  op.scale = unit_diagonal(A.diagonal());
  return op;
}

ModeOperator augmented_operator(const SymmetricMatrix& K, const Sieve& sieve) {
  const Eigen::Index n = K.rows();
  const Matrix P = sieve.P();
  const double size = K.diagonal().cwiseAbs().maxCoeff() / P.cwiseAbs().maxCoeff();
  const auto A = std::make_shared<SparseMatrix>(bordered(K.copied(), size * P));
  const auto factor = std::make_shared<linalg::SparseLu>(*A);
  if (factor->predicted_entries() > kMostEntries) {
    throw ModelError(
        fmt::format("method augmented: the factor of the bordered matrix of {} variables would "
                    "have {:.2g} entries, more than {:.2g}; use the method subspace",
                    n, factor->predicted_entries(), kMostEntries));
  }
  if (!factor->factorise(*A)) {
    throw NumericalError(
        "method augmented: the bordered matrix is singular to working precision; are parts of the "
        "mesh only loosely connected?");
  }
  ModeOperator op;
  op.factor_entries = factor->num_factor_entries();
  const Eigen::Index border = P.cols();
  op.inverse = [factor, n, border](Matrix& F) {
    Matrix X = Matrix::Zero(n + border, F.cols());
    X.topRows(n) = F;
    factor->solve_in_place(X);
    F = X.topRows(n);
  };
  op.multiply = [A](const Vector& x) -> Vector { return *A * x; };
  op.solve = [factor](const Vector& b) -> Vector {
    Vector x = b;
    factor->solve_in_place(x);
    return x;
  };
  // The zero block has no diagonal: its columns get the length one.
  op.scale.resize(n + border);
  op.scale.head(n) = unit_diagonal(K.diagonal());
  for (Eigen::Index k = 0; k < border; ++k) {
    op.scale[n + k] = 1.0 / (size * op.scale.head(n).cwiseProduct(P.col(k)).norm());
  }
  return op;
}

namespace {

ModeOperator full_penalty_operator(const SymmetricMatrix& K, const Matrix& P, double penalty) {
  const auto A = std::make_shared<Matrix>(Matrix(K.copied()) + penalty * P * P.transpose());
  const auto factor = std::make_shared<linalg::DenseCholesky>(*A);
  if (!factor->is_positive_definite()) {
    throw NumericalError("method penalty: K + c PPᵀ is not positive definite; check the mesh");
  }
  ModeOperator op;
  const auto n = static_cast<double>(K.rows());
  op.factor_entries = 0.5 * n * (n + 1.0);
  op.inverse = [factor](Matrix& F) { factor->solve_in_place(F); };
  op.multiply = [A](const Vector& x) -> Vector { return *A * x; };
  op.solve = [factor](const Vector& b) -> Vector { return factor->solve(b); };
  op.scale = unit_diagonal(A->diagonal());
  return op;
}

ModeOperator woodbury_penalty_operator(const SymmetricMatrix& M, const SymmetricMatrix& K,
                                       const Sieve& sieve, double penalty, double shift,
                                       const linalg::MakeFactor& make) {
  const linalg::MatrixSum A = shifted(K, shift, M);
  const auto factor = make(A);
  const auto P = std::make_shared<Matrix>(sieve.P());
  const auto Z = std::make_shared<Matrix>(factor->solve(*P));
  const Matrix small = Matrix::Identity(P->cols(), P->cols()) / penalty + P->transpose() * *Z;
  const auto inner = std::make_shared<linalg::DenseLdlt>(small);
  const auto solve = [factor, P, Z, inner](const Matrix& F) -> Matrix {
    Matrix X = factor->solve(F);
    X -= *Z * inner->solve(Matrix(P->transpose() * X));
    return X;
  };
  ModeOperator op;
  op.shift = shift;
  op.factor_entries = factor->num_factor_entries() + static_cast<double>(P->size() + Z->size());
  op.inverse = [solve](Matrix& F) { F = solve(F); };
  op.multiply = [&K, &M, shift, P, penalty](const Vector& x) -> Vector {
    return shifted_product(K, shift, M, x) + penalty * (*P * (P->transpose() * x));
  };
  op.solve = [solve](const Vector& b) -> Vector { return solve(b); };
  op.scale = unit_diagonal(A.diagonal() + penalty * P->rowwise().squaredNorm());
  return op;
}

}  // namespace

ModeOperator penalty_operator(const SymmetricMatrix& M, const SymmetricMatrix& K,
                              const Sieve& sieve, double penalty, double shift,
                              const linalg::MakeFactor& make) {
  ModeOperator op = K.rows() <= kFullPenalty
                        ? full_penalty_operator(K, sieve.P(), penalty)
                        : woodbury_penalty_operator(M, K, sieve, penalty, shift, make);
  op.penalty = penalty;
  return op;
}

double estimate_condition(const ModeOperator& op) {
  const Vector& s = op.scale;
  const double largest = largest_by_power(
      [&](const Vector& x) -> Vector { return s.cwiseProduct(op.multiply(s.cwiseProduct(x))); },
      s.size());
  const double inverse = largest_by_power(
      [&](const Vector& x) -> Vector { return op.solve(x.cwiseQuotient(s)).cwiseQuotient(s); },
      s.size());
  return largest * inverse;
}

}  // namespace buckens::body
