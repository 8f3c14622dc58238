// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "buckens/spatial/triangle_list.h"

namespace buckens::test {

/// Adds the faces of a block around a middle, each divided into n × n rectangles; each rectangle
/// has its own points.
inline void add_block(const Eigen::Vector3d& middle, const Eigen::Vector3d& half, int n,
                      spatial::TriangleList& out) {
  using Eigen::Vector3d;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {1.0, -1.0}) {
      const Vector3d u = half[(axis + 1) % 3] * Vector3d::Unit((axis + 1) % 3);
      const Vector3d v = side * half[(axis + 2) % 3] * Vector3d::Unit((axis + 2) % 3);
      const auto at = [&](int i, int j) -> Vector3d {
        return middle + side * half[axis] * Vector3d::Unit(axis) + (2.0 * i / n - 1.0) * u +
               (2.0 * j / n - 1.0) * v;
      };
      for (int k = 0; k < n * n; ++k) {
        const int i = k / n, j = k % n, first = static_cast<int>(out.points.size());
        for (const auto& [x, y] : {std::pair{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}}) {
          out.points.push_back(at(x, y));
        }
        out.triangles.push_back({first, first + 1, first + 2});
        out.triangles.push_back({first, first + 2, first + 3});
      }
    }
  }
}

}  // namespace buckens::test
