// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "buckens/fem/solid/shape.h"

namespace buckens::fem {

/// Points of a solid element at which strains are most accurate, and the polynomial that
/// extrapolates them to the nodes.
///
/// Hexahedra: 2×2×2 Gauss points, trilinear (Barlow, 1976); tet10: the four points of degree 2,
/// linear; wedges: three times two points; tet4 and pyramids: the centre, constant.
struct SolidSampling {
  struct Point {
    Eigen::Vector3d natural;
    SolidShape shape;
  };
  std::vector<Point> points;
  SolidShape centre;
  /// nodes × points: values at the nodes from values at the points; rows sum to 1.
  Eigen::MatrixXd to_nodes;
};

const SolidSampling& solid_sampling(SolidKind kind);

}  // namespace buckens::fem
