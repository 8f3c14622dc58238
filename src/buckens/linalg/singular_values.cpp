// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/singular_values.h"

#include <Eigen/SVD>

namespace buckens::linalg {

SingularValues singular_values(const Matrix& A, LeftVectors left) {
  const auto of_U = left == LeftVectors::full ? Eigen::ComputeFullU : Eigen::ComputeThinU;
  const Eigen::JacobiSVD<Matrix> svd(A, static_cast<unsigned>(of_U) | Eigen::ComputeThinV);
  return {svd.singularValues(), svd.matrixU(), svd.matrixV()};
}

Eigen::Index SingularValues::rank(double share) const {
  return values.size() == 0 ? 0 : (values.array() > share * values[0]).count();
}

Vector SingularValues::solve(const Vector& b) const {
  return V * (U.leftCols(values.size()).transpose() * b).cwiseQuotient(values);
}

}  // namespace buckens::linalg
