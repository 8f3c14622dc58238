// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/step/crossings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include <Eigen/Geometry>

namespace buckens::mesh_io {

using Eigen::Vector3d;

namespace {

// Of lengths and areas: triangles that touch are taken as crossing.
constexpr double kTouch = 1e-9;
// Sine of the angle below which triangles at a common edge lie on each other: a tenth of a degree.
constexpr double kFolded = 1.7e-3;

struct Triangle {
  std::array<std::size_t, 3> nodes;
  std::array<Vector3d, 3> at;
  Vector3d low, high;
  int face = 0;

  bool has(std::size_t node) const {
    return std::find(nodes.begin(), nodes.end(), node) != nodes.end();
  }
};

std::vector<Triangle> triangles_of(const PartMesh& mesh) {
  std::vector<Triangle> out;
  for (const PartMesh::Face& face : mesh.faces) {
    for (std::size_t k = 0; k + 2 < face.triangles.size(); k += 3) {
      Triangle own;
      own.face = face.number;
      for (std::size_t i = 0; i < 3; ++i) {
        own.nodes[i] = face.triangles[k + i];
        own.at[i] = mesh.positions.at(own.nodes[i]);
      }
      own.low = own.at[0].cwiseMin(own.at[1]).cwiseMin(own.at[2]);
      own.high = own.at[0].cwiseMax(own.at[1]).cwiseMax(own.at[2]);
      out.push_back(own);
    }
  }
  return out;
}

/// Where a segment meets a triangle that it is not parallel to.
std::optional<Vector3d> meeting(const Vector3d& from, const Vector3d& to, const Triangle& other) {
  const Vector3d along = to - from, u = other.at[1] - other.at[0], v = other.at[2] - other.at[0];
  const Vector3d h = along.cross(v);
  const double det = u.dot(h);
  if (std::abs(det) <= kTouch * along.norm() * u.norm() * v.norm()) return std::nullopt;
  const Vector3d s = from - other.at[0], q = s.cross(u);
  const double a = s.dot(h) / det, b = along.dot(q) / det, t = v.dot(q) / det;
  const bool is_inside =
      a >= -kTouch && b >= -kTouch && a + b <= 1 + kTouch && t >= -kTouch && t <= 1 + kTouch;
  if (!is_inside) return std::nullopt;
  return from + t * along;
}

/// An edge of one triangle, without a node of the other, that meets the other.
std::optional<Vector3d> edge_through(const Triangle& one, const Triangle& other) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    if (other.has(one.nodes[k]) || other.has(one.nodes[next])) continue;
    if (const auto found = meeting(one.at[k], one.at[next], other)) return found;
  }
  return std::nullopt;
}

/// Whether two triangles with a common edge are on the same side of it in one plane.
bool is_folded(const Triangle& one, const Triangle& other) {
  const auto tip =
      static_cast<std::size_t>(std::find_if(one.nodes.begin(), one.nodes.end(),
                                            [&](std::size_t node) { return !other.has(node); }) -
                               one.nodes.begin());
  const auto tip_of_other =
      static_cast<std::size_t>(std::find_if(other.nodes.begin(), other.nodes.end(),
                                            [&](std::size_t node) { return !one.has(node); }) -
                               other.nodes.begin());
  if (tip == 3 || tip_of_other == 3) return true;  // the same three nodes
  const Vector3d& a = one.at[(tip + 1) % 3];
  const Vector3d along = one.at[(tip + 2) % 3] - a;
  const Vector3d own = along.cross(one.at[tip] - a);
  const Vector3d others = along.cross(other.at[tip_of_other] - a);
  return own.dot(others) > 0 && own.cross(others).norm() < kFolded * own.norm() * others.norm();
}

std::optional<Vector3d> crossing(const Triangle& one, const Triangle& other) {
  const auto shared = std::count_if(one.nodes.begin(), one.nodes.end(),
                                    [&](std::size_t node) { return other.has(node); });
  if (shared >= 2) {
    if (!is_folded(one, other)) return std::nullopt;
    return (one.at[0] + one.at[1] + one.at[2]) / 3;
  }
  if (const auto found = edge_through(one, other)) return found;
  return edge_through(other, one);
}

bool are_apart(const Triangle& one, const Triangle& other) {
  return (one.low.array() > other.high.array()).any() ||
         (other.low.array() > one.high.array()).any();
}

}  // namespace

std::vector<SurfaceCrossing> surface_crossings(const PartMesh& mesh) {
  std::vector<Triangle> triangles = triangles_of(mesh);
  std::sort(triangles.begin(), triangles.end(),
            [](const Triangle& a, const Triangle& b) { return a.low[0] < b.low[0]; });
  std::vector<SurfaceCrossing> out;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Triangle& one = triangles[i];
    for (std::size_t j = i + 1; j < triangles.size(); ++j) {
      const Triangle& other = triangles[j];
      if (other.low[0] > one.high[0]) break;
      if (are_apart(one, other)) continue;
      if (const auto place = crossing(one, other)) {
        out.push_back({*place, {one.face, other.face}});
      }
    }
  }
  return out;
}

}  // namespace buckens::mesh_io
