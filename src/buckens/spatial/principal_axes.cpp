// SPDX-License-Identifier: Apache-2.0
#include "buckens/spatial/principal_axes.h"

#include <Eigen/Eigenvalues>

namespace buckens::spatial {

using Eigen::Matrix3d;

PrincipalAxes principal_axes(const Matrix3d& A) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(A);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

Eigen::Vector3d principal_values(const Matrix3d& A) {
  return Eigen::SelfAdjointEigenSolver<Matrix3d>(A, Eigen::EigenvaluesOnly).eigenvalues();
}

}  // namespace buckens::spatial
