// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/polyhedron_touch.h"

#include <algorithm>
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

namespace {

// By which boxes reach out of the plane of a planar model, in their own sizes: no side there
// counts.
constexpr double kOutOfPlane = 10.0;

double size_in_plane(const ContactShape& box) {
  Vector3d half = box.half;
  half[box.flat] = 0.0;
  return 2.0 * half.maxCoeff();
}

std::vector<Polyhedron::Corner> corners_in_plane(const ContactShape& box) {
  const int u = (box.flat + 1) % 3, v = (box.flat + 2) % 3;
  std::vector<Polyhedron::Corner> out;
  for (const auto& [x, y] : {std::pair{1.0, 1.0}, {-1.0, 1.0}, {-1.0, -1.0}, {1.0, -1.0}}) {
    const Vector3d along_u = x * Vector3d::Unit(u), along_v = y * Vector3d::Unit(v);
    out.push_back({box.half[u] * along_u + box.half[v] * along_v, {-along_u, -along_v}});
  }
  return out;
}

}  // namespace

TouchFinders flat_box_touches(const ContactShape& first, const ContactShape& second) {
  const double size = std::min(size_in_plane(first), size_in_plane(second));
  TouchFinders out;
  for (const bool is_second : {true, false}) {
    ContactShape faces = is_second ? first : second;
    faces.half[faces.flat] = kOutOfPlane * size_in_plane(faces);
    const auto sides = polyhedron_of(faces);
    const TouchFinders more =
        corners_on_faces(sides, corners_in_plane(is_second ? second : first), size, is_second);
    out.insert(out.end(), more.begin(), more.end());
  }
  return out;
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
