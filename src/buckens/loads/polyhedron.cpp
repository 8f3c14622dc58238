// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/polyhedron.h"

#include <algorithm>
#include <cmath>

#include "buckens/loads/mesh_topology.h"
#include "buckens/loads/sharp_edges.h"

namespace buckens::loads {

using Eigen::AlignedBox3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

// Lengths are the same within this share of the size: of files in single precision, too.
constexpr double kSameLength = 1e-8;
// Neighbours are one patch up to here [rad]: none that bends.
constexpr double kNoBend = 1e-8;
// Sine by which an edge may dip below the face that it is told to touch: what a body turns by
// within a step, far below the angles between faces that a corner could come through instead.
constexpr double kDip = 0.1;
// Share by which a distance may differ from that along the normal and still be that.
constexpr double kAcross = 1e-10;

Polyhedron::Corner corner_at(const MeshTopology& from, std::size_t point) {
  Polyhedron::Corner out{from.points[point], {}};
  for (int k = from.first_at[point]; k < from.first_at[point + 1]; ++k) {
    const auto t = static_cast<std::size_t>(from.at_point[static_cast<std::size_t>(k)]);
    for (const int other : from.triangles[t]) {
      if (other == static_cast<int>(point)) continue;
      const Vector3d way =
          (from.points[static_cast<std::size_t>(other)] - from.points[point]).normalized();
      // Two triangles share an edge.
      const bool is_known = std::any_of(out.along.begin(), out.along.end(),
                                        [&](const Vector3d& known) { return known == way; });
      if (!is_known) out.along.push_back(way);
    }
  }
  return out;
}

}  // namespace

bool Polyhedron::Edge::looks_out(const Vector3d& direction) const {
  return direction.dot(into[0]) <= kDip && direction.dot(into[1]) <= kDip;
}

Polyhedron::Polyhedron(const ContactMesh& mesh) : Polyhedron(mesh.flat_triangles()) {}

Polyhedron::Polyhedron(const spatial::TriangleList& list) : flat_(list, kNoBend) {
  const MeshTopology from(list, kNoBend, ContactMesh::kMostColours);
  edges_ = sharp_edges(from);
  same_ = kSameLength * size();
  for (std::size_t k = 0; k < flat_.num_facets(); ++k) {
    const auto& c = flat_.corners(k);
    normals_.push_back((c[1] - c[0]).cross(c[2] - c[0]).normalized());
    face_boxes_.emplace_back(c[0].cwiseMin(c[1]).cwiseMin(c[2]),
                             c[0].cwiseMax(c[1]).cwiseMax(c[2]));
  }
  for (const Edge& edge : edges_) {
    const Vector3d reach = edge.half.cwiseAbs();
    edge_boxes_.emplace_back(edge.middle - reach, edge.middle + reach);
  }
  const std::vector<char> is_corner = corner_points(from);
  for (std::size_t p = 0; p < is_corner.size(); ++p) {
    if (is_corner[p] != 0) corners_.push_back(corner_at(from, p));
  }
}

spatial::TouchSurface::View Polyhedron::beside(int facet, const Vector3d& x) const {
  const CurvedFacet& face = flat_.facet(static_cast<std::size_t>(facet));
  const CurvedFacet::Place place = face.nearest(x);
  spatial::TouchSurface::View out;
  out.normal = normal(facet);
  out.distance = std::sqrt(place.square);
  if (!(out.distance > 0.0)) return out;
  out.normal = (x - place.at) / out.distance;
  out.curvature = face.curvature(x, place);
  return out;
}

Polyhedron::Sight Polyhedron::see(const Vector3d& x, const Matrix3d& R, const Corner& corner,
                                  double deepest) const {
  const auto height = [&](int facet) {
    return normal(facet).dot(x - flat_.corners(static_cast<std::size_t>(facet))[0]);
  };
  const auto dips = [&](int facet) {
    const Vector3d out_of = R.transpose() * normal(facet);
    return std::any_of(corner.along.begin(), corner.along.end(),
                       [&](const Vector3d& way) { return way.dot(out_of) < -kDip; });
  };
  const ContactMesh::Nearest near = flat_.nearest(x);
  Sight out;
  out.facet = near.facet;
  out.gap = std::abs(near.distance);
  if (near.distance > same_) {
    const double over = height(near.facet);
    out.is_across = over >= (1.0 - kAcross) * near.distance && !dips(near.facet);
    if (out.is_across) out.gap = over;
    return out;
  }
  double least = deepest;
  flat_.tree().search(
      [&](const AlignedBox3d& box) { return box.squaredExteriorDistance(x); },
      [&](double square, std::uint32_t /*marks*/) { return square <= least * least; },
      [&](int facet) {
        const double over = height(facet);
        if (over > same_ || !(std::abs(over) < least)) return;
        if (dips(facet)) return;
        const Vector3d foot = x - over * normal(facet);
        const CurvedFacet& face = flat_.facet(static_cast<std::size_t>(facet));
        if (face.nearest(foot).square > same_ * same_) return;
        least = std::abs(over);
        out = {facet, true, over};
      });
  return out;
}

}  // namespace buckens::loads
