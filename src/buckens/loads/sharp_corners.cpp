// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "buckens/loads/contact_mesh.h"
#include "buckens/loads/mesh_topology.h"

namespace buckens::loads {

using Eigen::Vector3d;

bool are_in_plane(const std::vector<Vector3d>& normals) {
  Vector3d across = Vector3d::Zero();
  for (const Vector3d& n : normals) {
    const Vector3d turned = normals.front().cross(n);
    if (turned.squaredNorm() > across.squaredNorm()) across = turned;
  }
  if (across.norm() < kFlatCorner) return true;
  across.normalize();
  return std::none_of(normals.begin(), normals.end(),
                      [&](const Vector3d& n) { return std::abs(across.dot(n)) > kFlatCorner; });
}

std::vector<Vector3d> ContactMesh::sharp_corners() const {
  std::vector<Vector3d> out;
  std::vector<Vector3d> normals;
  for (std::size_t v = 0; v + 1 < first_at_.size(); ++v) {
    const auto begin = static_cast<std::size_t>(first_at_[v]);
    const auto end = static_cast<std::size_t>(first_at_[v + 1]);
    if (begin == end) continue;
    normals.clear();
    Vector3d at = Vector3d::Zero();
    for (std::size_t k = begin; k < end; ++k) {
      const auto t = static_cast<std::size_t>(at_vertex_[k]);
      const auto& c = facets_[t].corner;
      normals.push_back((c[1] - c[0]).cross(c[2] - c[0]).normalized());
      const auto& own = vertices_[t];
      at = c[static_cast<std::size_t>(std::find(own.begin(), own.end(), static_cast<int>(v)) -
                                      own.begin())];
    }
    const bool is_on_border = outwards_[v].isZero(0.0);
    if (is_on_border || !are_in_plane(normals)) out.push_back(at);
  }
  return out;
}

}  // namespace buckens::loads
