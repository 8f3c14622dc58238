// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "buckens/spatial/triangle_list.h"

namespace buckens::test {

/// A round surface of triangles between circles.
inline spatial::TriangleList triangle_ball(double radius, int around, int across) {
  spatial::TriangleList out;
  const auto at = [&](int i, int j) { return (i % around) * (across + 1) + j; };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j <= across; ++j) {
      const double a = 2 * M_PI * i / around, b = M_PI * j / across;
      out.points.emplace_back(radius * std::sin(b) * std::cos(a),
                              radius * std::sin(b) * std::sin(a), -radius * std::cos(b));
    }
  }
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      out.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      out.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return out;
}

}  // namespace buckens::test
