// SPDX-License-Identifier: Apache-2.0
// Decompositions of dense matrices that are compiled once: what they return, in terms of products.
#include <cmath>

#include <gtest/gtest.h>

#include "buckens/linalg/dense_cholesky.h"
#include "buckens/linalg/dense_ldlt.h"
#include "buckens/linalg/pivoted_qr.h"
#include "buckens/linalg/pseudo_inverse.h"
#include "buckens/linalg/singular_values.h"
#include "buckens/linalg/small_lu.h"
#include "buckens/linalg/sparse_ldlt.h"
#include "buckens/linalg/symmetric_eigen.h"

namespace buckens::linalg {

namespace {

constexpr double kDigitsOfDense = 1e-13;

/// A full matrix without structure.
Matrix scattered_matrix(Eigen::Index rows, Eigen::Index columns) {
  Matrix out(rows, columns);
  for (Eigen::Index i = 0; i < rows; ++i) {
    for (Eigen::Index j = 0; j < columns; ++j) {
      const auto x = static_cast<double>(i), y = static_cast<double>(j);
      out(i, j) = std::sin(1.0 + 3.7 * x + 1.9 * y * (x + y));
    }
  }
  return out;
}

Matrix positive_definite(Eigen::Index size) {
  const Matrix A = scattered_matrix(size, size);
  return A * A.transpose() + Matrix::Identity(size, size);
}

}  // namespace

TEST(DenseDecompositions, EigenvectorsDiagonaliseASymmetricMatrix) {
  const Matrix A = positive_definite(5);
  const SymmetricEigen eigen = symmetric_eigen(A);
  EXPECT_LT((A * eigen.vectors - eigen.vectors * eigen.values.asDiagonal()).norm(),
            kDigitsOfDense * A.norm());
  EXPECT_LT((symmetric_eigenvalues(A) - eigen.values).norm(), kDigitsOfDense * A.norm());
  EXPECT_LE(eigen.values[0], eigen.values[4]);
}

TEST(DenseDecompositions, EigenvaluesOfATridiagonalMatrixAreThoseOfTheFullOne) {
  const Vector diagonal = Vector::LinSpaced(4, 1.0, 4.0), beside = Vector::Constant(3, 0.5);
  Matrix A = diagonal.asDiagonal();
  A.diagonal(1) = beside;
  A.diagonal(-1) = beside;
  EXPECT_LT((tridiagonal_eigen(diagonal, beside).values - symmetric_eigenvalues(A)).norm(),
            kDigitsOfDense * A.norm());
}

TEST(DenseDecompositions, GeneralisedEigenvectorsAreOrthonormalInTheSecondMatrix) {
  const Matrix A = scattered_matrix(5, 5) + scattered_matrix(5, 5).transpose(),
               B = positive_definite(5);
  const auto eigen = generalised_eigen(A, B);
  ASSERT_TRUE(eigen);
  EXPECT_LT((A * eigen->vectors - B * eigen->vectors * eigen->values.asDiagonal()).norm(),
            kDigitsOfDense * B.norm() * A.norm());
  const Matrix gram = eigen->vectors.transpose() * B * eigen->vectors;
  EXPECT_LT((gram - Matrix::Identity(5, 5)).norm(), kDigitsOfDense * B.norm());
}

TEST(DenseDecompositions, LdltSolvesWhatIsSemidefinite) {
  const Matrix half = scattered_matrix(5, 3), A = half * half.transpose(),
               x = A * scattered_matrix(5, 2);
  const DenseLdlt factor(A);
  EXPECT_LT((A * factor.solve(Matrix(A * x)) - A * x).norm(), 1e-9 * (A * x).norm());
  const Matrix B = positive_definite(5);
  const Vector b = scattered_matrix(5, 1);
  EXPECT_LT((B * DenseLdlt(B).solve(b) - b).norm(), kDigitsOfDense * B.norm());
}

TEST(DenseDecompositions, SparseLdltHasTheInertiaOfItsMatrix) {
  Matrix A = positive_definite(6);
  A(2, 2) -= 2 * A.norm();
  const SparseMatrix sparse = A.sparseView();
  SparseLdlt factor;
  factor.analyse(sparse);
  ASSERT_TRUE(factor.factorise(sparse));
  EXPECT_EQ((factor.diagonal().array() < 0).count(), 1);
  const Vector b = scattered_matrix(6, 1);
  EXPECT_LT((A * factor.solve(b) - b).norm(), kDigitsOfDense * A.norm());
  EXPECT_FALSE(factor.factorise(SparseMatrix(0 * sparse)));
}

TEST(DenseDecompositions, PivotedQrFindsRankAndComplement) {
  const Matrix A = scattered_matrix(6, 2) * scattered_matrix(2, 4);
  const PivotedQr qr(A, 1e-10);
  EXPECT_EQ(qr.rank(), 2);
  EXPECT_EQ(qr.order().size(), 4U);
  const Matrix Z = qr.complement();
  EXPECT_EQ(Z.cols(), 4);
  EXPECT_LT((A.transpose() * Z).norm(), kDigitsOfDense * A.norm());
  EXPECT_LT((Z.transpose() * Z - Matrix::Identity(4, 4)).norm(), kDigitsOfDense);
}

TEST(DenseDecompositions, OrthonormalSpanHoldsTheColumns) {
  const Matrix A = scattered_matrix(6, 3), Q = orthonormal_span(A);
  EXPECT_LT((Q.transpose() * Q - Matrix::Identity(3, 3)).norm(), kDigitsOfDense);
  EXPECT_LT((A - Q * (Q.transpose() * A)).norm(), kDigitsOfDense * A.norm());
}

TEST(DenseDecompositions, PseudoInverseGivesTheShortestLeastSquares) {
  const Matrix A = scattered_matrix(6, 2) * scattered_matrix(2, 4);
  PseudoInverse inverse(1e-10);
  inverse.compute(A);
  const Vector b = scattered_matrix(6, 1), x = inverse * b;
  EXPECT_LT((A.transpose() * (A * x - b)).norm(), kDigitsOfDense * A.squaredNorm());
  EXPECT_LT((x - inverse.whole() * b).norm(), kDigitsOfDense * b.norm());
  // In the span of the rows: nothing of it could be left out.
  const Matrix none = PivotedQr(A.transpose(), 1e-10).complement();
  EXPECT_LT((none.transpose() * x).norm(), kDigitsOfDense * x.norm());
}

TEST(DenseDecompositions, CholeskySolvesAndTellsWhatIsNotPositiveDefinite) {
  const Matrix A = positive_definite(5), B = scattered_matrix(5, 3);
  const DenseCholesky factor(A);
  ASSERT_TRUE(factor.is_positive_definite());
  EXPECT_LT((factor.lower() * factor.lower().transpose() - A).norm(), kDigitsOfDense * A.norm());
  EXPECT_LT((A * factor.solve(B) - B).norm(), kDigitsOfDense * A.norm());
  EXPECT_LT((factor.lower() * factor.solve_lower(B) - B).norm(), kDigitsOfDense * A.norm());
  EXPECT_FALSE(DenseCholesky(-A).is_positive_definite());
}

TEST(DenseDecompositions, SingularValuesAndLuSolve) {
  const Matrix A = scattered_matrix(6, 3);
  const SingularValues svd = singular_values(A, LeftVectors::full);
  EXPECT_EQ(svd.U.cols(), 6);
  EXPECT_EQ(svd.rank(1e-10), 3);
  const Vector b = scattered_matrix(6, 1), x = svd.solve(b);
  EXPECT_LT((A.transpose() * (A * x - b)).norm(), kDigitsOfDense * A.squaredNorm());
  const Matrix C = positive_definite(4) + scattered_matrix(4, 4);
  EXPECT_LT((C * general_inverse(C) - Matrix::Identity(4, 4)).norm(), kDigitsOfDense * C.norm());
  EXPECT_LT((C * general_solution(C, scattered_matrix(4, 2)) - scattered_matrix(4, 2)).norm(),
            kDigitsOfDense * C.norm());
}

}  // namespace buckens::linalg
