// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/contact_mesh.h"

#include <algorithm>
#include <cmath>

#include "buckens/loads/mesh_topology.h"

namespace buckens::loads {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

namespace {

// Places on both sides of one border are the same if they are this near, as a share of the size.
constexpr double kSameBorder = 1e-9;
// Spacing of springs as a share of the side of the mean face, of which a surface has six.
constexpr double kSpacing = 0.2, kFaces = 6.0;
/// Sums over the triangles at a point. @param term (triangle, its corner there)
template <class Term>
Vector3d sum_at(const MeshTopology& from, int point, Term&& term) {
  Vector3d sum = Vector3d::Zero();
  const auto p = static_cast<std::size_t>(point);
  for (int k = from.first_at[p]; k < from.first_at[p + 1]; ++k) {
    const auto t = static_cast<std::size_t>(from.at_point[static_cast<std::size_t>(k)]);
    const auto& corners = from.triangles[t];
    const auto corner = std::find(corners.begin(), corners.end(), point) - corners.begin();
    sum += term(t, static_cast<std::size_t>(corner));
  }
  return sum;
}

/// Normal of a patch at one of its points: Max's weights (1999), exact where all corners are on a
/// sphere.
Vector3d patch_normal(const MeshTopology& from, int point, int patch) {
  return sum_at(from, point,
                [&](std::size_t t, std::size_t corner) -> Vector3d {
                  if (from.patches[t] != patch) return Vector3d::Zero();
                  const auto& corners = from.triangles[t];
                  const auto at = [&](std::size_t k) {
                    return from.points[static_cast<std::size_t>(corners[k % 3])];
                  };
                  const Vector3d a = at(corner + 1) - at(corner), b = at(corner + 2) - at(corner);
                  return a.cross(b) / (a.squaredNorm() * b.squaredNorm());
                })
      .normalized();
}

/// Direction out of the solid at a point: normals weighted by angles.
Vector3d outwards_at(const MeshTopology& from, int point) {
  return sum_at(from, point,
                [&](std::size_t t, std::size_t corner) -> Vector3d {
                  return from.angle(t, corner) * from.normals[t];
                })
      .normalized();
}

std::vector<CurvedFacet> curved_facets(const MeshTopology& from) {
  std::vector<CurvedFacet> out(from.triangles.size());
  for (std::size_t t = 0; t < out.size(); ++t) {
    std::array<Vector3d, 3> normal;
    for (std::size_t k = 0; k < 3; ++k) {
      out[t].corner[k] = from.points[static_cast<std::size_t>(from.triangles[t][k])];
      normal[k] = patch_normal(from, from.triangles[t][k], from.patches[t]);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      const int beyond = from.neighbours[t][k];
      // Sharp edges stay straight: their patches meet there.
      const bool is_inside =
          beyond >= 0 && from.patches[static_cast<std::size_t>(beyond)] == from.patches[t];
      out[t].bulge[k] = is_inside ? CurvedFacet::bulge_between(out[t].corner[k], normal[k],
                                                               out[t].corner[next], normal[next])
                                  : Vector3d(Vector3d::Zero());
      // What rounding makes of a flat surface is flat.
      const double length = (out[t].corner[next] - out[t].corner[k]).norm();
      if (out[t].bulge[k].norm() < 1e-7 * length) out[t].bulge[k].setZero();
    }
  }
  return out;
}

std::vector<AlignedBox3d> boxes_around(const std::vector<CurvedFacet>& facets) {
  std::vector<AlignedBox3d> out(facets.size());
  for (std::size_t k = 0; k < facets.size(); ++k) {
    for (const Vector3d& point : facets[k].hull()) out[k].extend(point);
  }
  return out;
}

std::vector<std::uint32_t> colour_bits(const MeshTopology& from) {
  std::vector<std::uint32_t> out;
  for (const int patch : from.patches) {
    out.push_back(1U << static_cast<unsigned>(from.colours[static_cast<std::size_t>(patch)]));
  }
  return out;
}

}  // namespace

ContactMesh::ContactMesh(const spatial::TriangleList& triangles, double smooth, double spacing)
    : ContactMesh(MeshTopology(triangles, smooth, kMostColours), spacing) {}

ContactMesh::ContactMesh(const MeshTopology& from, double spacing)
    : facets_(curved_facets(from)),
      vertices_(from.triangles),
      neighbours_(from.neighbours),
      patches_(from.patches),
      colours_(from.colours),
      first_at_(from.first_at),
      at_vertex_(from.at_point),
      tree_(boxes_around(facets_), colour_bits(from)),
      num_patches_(from.num_patches),
      num_colours_(from.num_colours),
      is_closed_(from.is_closed) {
  for (const double area : from.areas) area_ += area;
  spacing_ = spacing > 0.0 ? spacing : kSpacing * std::sqrt(area_ / kFaces);
  for (const auto& facet : facets_) {
    for (const Vector3d& corner : facet.corner) box_.extend(corner);
  }
  for (std::size_t p = 0; p < from.points.size(); ++p) {
    outwards_.push_back(outwards_at(from, static_cast<int>(p)));
  }
  for (std::size_t t = 0; t < facets_.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (neighbours_[t][k] >= 0) continue;
      outwards_[static_cast<std::size_t>(vertices_[t][k])].setZero();
      outwards_[static_cast<std::size_t>(vertices_[t][(k + 1) % 3])].setZero();
    }
  }
}

const SurfacePoints& ContactMesh::springs() const {
  std::call_once(springs_made_, [this] {
    std::vector<std::array<bool, 3>> is_sharp(facets_.size());
    for (std::size_t t = 0; t < facets_.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const int beyond = neighbours_[t][k];
        is_sharp[t][k] = beyond < 0 || patches_[static_cast<std::size_t>(beyond)] != patches_[t];
      }
    }
    springs_.emplace(facets_, is_sharp, spacing_);
  });
  return *springs_;
}

Vector3d ContactMesh::outwards(int facet, const CurvedFacet::Place& place) const {
  if (place.feature < 0) return place.normal.normalized();
  const auto t = static_cast<std::size_t>(facet);
  if (place.feature >= 3) {
    return outwards_[static_cast<std::size_t>(
        vertices_[t][static_cast<std::size_t>(place.feature - 3)])];
  }
  const int other = neighbours_[t][static_cast<std::size_t>(place.feature)];
  if (other < 0) return Vector3d::Zero();
  const auto o = static_cast<std::size_t>(other);
  if (patches_[o] == patches_[t]) return place.normal.normalized();
  const auto& c = facets_[o].corner;
  return place.normal.normalized() + (c[1] - c[0]).cross(c[2] - c[0]).normalized();
}

ContactMesh::Nearest ContactMesh::finish(const Vector3d& point, int facet,
                                         const CurvedFacet::Place& place) const {
  Nearest out;
  out.facet = facet;
  out.at = place.at;
  const Vector3d away = point - place.at;
  const double distance = std::sqrt(place.square);
  const Vector3d out_of = outwards(facet, place);
  // Beside an open surface is nowhere inside.
  const double side = away.dot(out_of) < 0.0 ? -1.0 : 1.0;
  out.distance = side * distance;
  if (distance > 0.0) {
    out.normal = side / distance * away;
  } else {
    out.normal = out_of.isZero(0.0) ? place.normal.normalized() : out_of.normalized();
  }
  return out;
}

ContactMesh::Nearest ContactMesh::nearest(const Vector3d& point) const {
  CurvedFacet::Place best;
  best.square = HUGE_VAL;
  int facet = -1;
  tree_.search([&](const AlignedBox3d& box) { return box.squaredExteriorDistance(point); },
               [&](double square, std::uint32_t /*marks*/) { return square < best.square; },
               [&](int item) {
                 const CurvedFacet::Place place =
                     facets_[static_cast<std::size_t>(item)].nearest(point);
                 if (!(place.square < best.square)) return;
                 best = place;
                 facet = item;
               });
  return finish(point, facet, best);
}

bool ContactMesh::goes_on(const Vector3d& point, int facet, const CurvedFacet::Place& place) const {
  const auto t = static_cast<std::size_t>(facet);
  const double same = kSameBorder * box_.diagonal().norm();
  const auto takes_over = [&](int other) {
    const auto o = static_cast<std::size_t>(other);
    if (patches_[o] == patches_[t]) return false;
    const CurvedFacet::Place there = facets_[o].nearest(point);
    if (there.feature < 0) return true;
    if ((there.at - place.at).norm() <= same) return patches_[o] < patches_[t];
    return there.square < place.square;
  };
  if (place.feature < 3) {
    const int other = neighbours_[t][static_cast<std::size_t>(place.feature)];
    return other >= 0 && takes_over(other);
  }
  const auto vertex =
      static_cast<std::size_t>(vertices_[t][static_cast<std::size_t>(place.feature - 3)]);
  const auto begin = at_vertex_.begin() + first_at_[vertex];
  const auto end = at_vertex_.begin() + first_at_[vertex + 1];
  return std::any_of(begin, end, takes_over);
}

void ContactMesh::nearest_of_colours(const Vector3d& point, double reach,
                                     std::span<Nearest> out) const {
  std::array<CurvedFacet::Place, kMostColours> best;
  std::array<int, kMostColours> facets;
  const auto count = static_cast<std::size_t>(num_colours_);
  for (std::size_t c = 0; c < count; ++c) {
    best[c].square = reach * reach;
    facets[c] = -1;
  }
  tree_.search([&](const AlignedBox3d& box) { return box.squaredExteriorDistance(point); },
               [&](double square, std::uint32_t marks) {
                 for (std::size_t c = 0; c < count; ++c) {
                   if ((marks & (1U << c)) != 0 && square < best[c].square) return true;
                 }
                 return false;
               },
               [&](int item) {
                 const auto t = static_cast<std::size_t>(item);
                 const auto c =
                     static_cast<std::size_t>(colours_[static_cast<std::size_t>(patches_[t])]);
                 const CurvedFacet::Place place = facets_[t].nearest(point);
                 if (!(place.square < best[c].square)) return;
                 best[c] = place;
                 facets[c] = item;
               });
  for (std::size_t c = 0; c < count; ++c) {
    out[c] = {};
    if (facets[c] < 0) continue;
    out[c] = finish(point, facets[c], best[c]);
    if (best[c].feature >= 0 && goes_on(point, facets[c], best[c])) out[c].distance = HUGE_VAL;
  }
}

spatial::TriangleList ContactMesh::flat_triangles() const {
  spatial::TriangleList out;
  for (const CurvedFacet& facet : facets_) {
    const int first = static_cast<int>(out.points.size());
    for (const Vector3d& x : facet.corner) out.points.push_back(x);
    out.triangles.push_back({first, first + 1, first + 2});
  }
  return out;
}

spatial::TouchSurface::View ContactMesh::look(const Vector3d& point, int colour) const {
  CurvedFacet::Place best;
  best.square = HUGE_VAL;
  int facet = -1;
  const std::uint32_t wanted = 1U << static_cast<unsigned>(colour);
  tree_.search([&](const AlignedBox3d& box) { return box.squaredExteriorDistance(point); },
               [&](double square, std::uint32_t marks) {
                 return (marks & wanted) != 0 && square < best.square;
               },
               [&](int item) {
                 const auto t = static_cast<std::size_t>(item);
                 if (colours_[static_cast<std::size_t>(patches_[t])] != colour) return;
                 const CurvedFacet::Place place = facets_[t].nearest(point);
                 if (!(place.square < best.square)) return;
                 best = place;
                 facet = item;
               });
  spatial::TouchSurface::View out;
  out.distance = std::sqrt(best.square);
  if (!(out.distance > 0.0)) {
    out.normal = best.normal.normalized();
    return out;
  }
  out.normal = (point - best.at) / out.distance;
  out.curvature = facets_[static_cast<std::size_t>(facet)].curvature(point, best);
  return out;
}

}  // namespace buckens::loads
