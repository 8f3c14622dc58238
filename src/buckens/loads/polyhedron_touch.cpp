// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/polyhedron_touch.h"

#include <utility>

namespace buckens::loads {

using Eigen::Vector3d;

std::shared_ptr<const Polyhedron> polyhedron_of(const ContactShape& shape) {
  if (shape.kind == ContactShape::Kind::mesh) {
    return std::make_shared<const Polyhedron>(*shape.mesh);
  }
  spatial::TriangleList box;
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const double side : {1.0, -1.0}) {
      const int first = static_cast<int>(box.points.size());
      for (const auto& [x, y] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}) {
        Vector3d at = shape.half;
        at[axis] *= side;
        at[u] *= x;
        at[v] *= side * y;
        box.points.push_back(at);
      }
      box.triangles.push_back({first, first + 1, first + 2});
      box.triangles.push_back({first, first + 2, first + 3});
    }
  }
  return std::make_shared<const Polyhedron>(box);
}

TouchFinders polyhedron_touches(const std::shared_ptr<const Polyhedron>& first,
                                const std::shared_ptr<const Polyhedron>& second) {
  TouchFinders out = corners_on_faces(first, second->corners(), second->size(), true);
  for (const TouchFinders& more : {corners_on_faces(second, first->corners(), first->size(), false),
                                   edges_across(first, second)}) {
    out.insert(out.end(), more.begin(), more.end());
  }
  return out;
}

}  // namespace buckens::loads
