// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/symmetric_root.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace buckens::loads {

Eigen::Matrix2d symmetric_root(const Eigen::Matrix2d& square) {
  const double det = std::sqrt(std::max(0.0, square.determinant()));
  const double size = std::sqrt(std::max(0.0, square.trace() + 2.0 * det));
  if (size == 0.0) return Eigen::Matrix2d::Zero();
  return (square + det * Eigen::Matrix2d::Identity()) / size;
}

}  // namespace buckens::loads
