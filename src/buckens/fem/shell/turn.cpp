// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/shell/turn.h"

#include <cmath>

#include "buckens/spatial/rotation.h"

namespace buckens::fem {

using Eigen::Matrix3d;
using Eigen::Vector3d;

double turn_between(const Matrix3d& from, const Matrix3d& to) {
  const Vector3d x = spatial::rotation_between(from.col(2), to.col(2)) * from.col(0);
  return std::atan2(x.dot(to.col(1)), x.dot(to.col(0)));
}

Matrix3d strain_in_other_axes(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  Matrix3d T;
  T << c * c, s * s, -c * s, s * s, c * c, c * s, 2 * c * s, -2 * c * s, c * c - s * s;
  return T;
}

}  // namespace buckens::fem
