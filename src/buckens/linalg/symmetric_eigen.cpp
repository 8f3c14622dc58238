// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/symmetric_eigen.h"

#include <Eigen/Eigenvalues>

namespace buckens::linalg {

SymmetricEigen symmetric_eigen(const Matrix& A) {
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(A);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

Vector symmetric_eigenvalues(const Matrix& A) {
  return Eigen::SelfAdjointEigenSolver<Matrix>(A, Eigen::EigenvaluesOnly).eigenvalues();
}

SymmetricEigen tridiagonal_eigen(const Vector& diagonal, const Vector& beside) {
  Eigen::SelfAdjointEigenSolver<Matrix> eigen;
  eigen.computeFromTridiagonal(diagonal, beside);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

std::optional<SymmetricEigen> generalised_eigen(const Matrix& A, const Matrix& B) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> eigen(A, B);
  if (eigen.info() != Eigen::Success) return std::nullopt;
  return SymmetricEigen{eigen.eigenvalues(), eigen.eigenvectors()};
}

}  // namespace buckens::linalg
