// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

namespace buckens::spatial {

/// A triangulated surface, with corners counter-clockwise seen from outside.
struct TriangleList {
  std::vector<Eigen::Vector3d> points;  ///< [m]; several may be at one place
  std::vector<std::array<int, 3>> triangles;
};

}  // namespace buckens::spatial
