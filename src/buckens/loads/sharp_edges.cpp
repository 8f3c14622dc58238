// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/sharp_edges.h"

#include <cmath>

#include "buckens/loads/mesh_topology.h"

namespace buckens::loads {

using Eigen::Vector3d;

namespace {

/// One side of a triangle that stands out of the surface.
struct EdgePiece {
  int from, to;  // points
  std::array<Vector3d, 2> into;
};

class EdgeChains {
 public:
  explicit EdgeChains(const MeshTopology& from)
      : from_(from), is_corner_(corner_points(from)), at_point_(from.points.size()) {
    for (std::size_t t = 0; t < from.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) add(t, k);
    }
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      for (const int end : {pieces_[p].from, pieces_[p].to}) {
        at_point_[static_cast<std::size_t>(end)].push_back(static_cast<int>(p));
      }
    }
  }

  std::vector<Polyhedron::Edge> join() {
    std::vector<Polyhedron::Edge> out;
    is_taken_.assign(pieces_.size(), 0);
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      if (is_taken_[p] != 0) continue;
      is_taken_[p] = 1;
      const Vector3d way = (point(pieces_[p].to) - point(pieces_[p].from)).normalized();
      const Vector3d first = point(end_of_chain(pieces_[p].from, -way));
      const Vector3d last = point(end_of_chain(pieces_[p].to, way));
      out.push_back({0.5 * (first + last), 0.5 * (last - first), pieces_[p].into});
    }
    return out;
  }

 private:
  const Vector3d& point(int k) const { return from_.points[static_cast<std::size_t>(k)]; }

  /// The side from corner k to the next, if it stands out; once for both of its triangles.
  void add(std::size_t t, std::size_t k) {
    const int beyond = from_.neighbours[t][k];
    if (beyond >= 0 && beyond < static_cast<int>(t)) return;
    if (beyond >= 0 && from_.patches[t] == from_.patches[static_cast<std::size_t>(beyond)]) return;
    const auto& corners = from_.triangles[t];
    EdgePiece out{corners[k], corners[(k + 1) % 3], {}};
    const Vector3d way = (point(out.to) - point(out.from)).normalized();
    out.into[0] = from_.normals[t].cross(way);
    // At the border of an open surface as if a wall went down there.
    out.into[1] = -from_.normals[t];
    if (beyond >= 0) {
      out.into[1] = way.cross(from_.normals[static_cast<std::size_t>(beyond)]);
      if (from_.normals[t].dot(out.into[1]) > -kFlatCorner) return;
    }
    pieces_.push_back(out);
  }

  /// Goes on straight from a point. @return the last point
  int end_of_chain(int at, const Vector3d& way) {
    while (is_corner_[static_cast<std::size_t>(at)] == 0) {
      int next = -1;
      for (const int p : at_point_[static_cast<std::size_t>(at)]) {
        const EdgePiece& piece = pieces_[static_cast<std::size_t>(p)];
        const int end = piece.from == at ? piece.to : piece.from;
        if (is_taken_[static_cast<std::size_t>(p)] != 0) continue;
        const Vector3d on = (point(end) - point(at)).normalized();
        if (on.dot(way) < 0.0 || on.cross(way).norm() > kFlatCorner) continue;
        is_taken_[static_cast<std::size_t>(p)] = 1;
        next = end;
        break;
      }
      if (next < 0) break;
      at = next;
    }
    return at;
  }

  const MeshTopology& from_;
  std::vector<char> is_corner_, is_taken_;
  std::vector<std::vector<int>> at_point_;  // pieces
  std::vector<EdgePiece> pieces_;
};

}  // namespace

std::vector<char> corner_points(const MeshTopology& from) {
  std::vector<char> out(from.points.size());
  for (std::size_t t = 0; t < from.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (from.neighbours[t][k] >= 0) continue;
      out[static_cast<std::size_t>(from.triangles[t][k])] = 1;
      out[static_cast<std::size_t>(from.triangles[t][(k + 1) % 3])] = 1;
    }
  }
  std::vector<Vector3d> normals;
  for (std::size_t p = 0; p < from.points.size(); ++p) {
    normals.clear();
    for (int k = from.first_at[p]; k < from.first_at[p + 1]; ++k) {
      const int t = from.at_point[static_cast<std::size_t>(k)];
      normals.push_back(from.normals[static_cast<std::size_t>(t)]);
    }
    if (!normals.empty() && !are_in_plane(normals)) out[p] = 1;
  }
  return out;
}

std::vector<Polyhedron::Edge> sharp_edges(const MeshTopology& from) {
  return EdgeChains(from).join();
}

std::vector<Polyhedron::Edge> sharp_edges(const ContactMesh& mesh) {
  // Its facets are those of the topology it was made from, whose patches hold here.
  MeshTopology from(mesh.flat_triangles(), kFlatCorner, ContactMesh::kMostColours);
  for (std::size_t t = 0; t < mesh.num_facets(); ++t) from.patches[t] = mesh.patch(t);
  return sharp_edges(from);
}

}  // namespace buckens::loads
