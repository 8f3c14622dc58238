// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/mesh_spots.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "buckens/loads/symmetric_root.h"

namespace buckens::loads {

using Eigen::AlignedBox3d;
using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

// Patches are looked for within this many radii of a sphere's centre: what it meets is seen before.
constexpr double kReach = 2.0;
// Faces of a cube: a sixth of a surface stands for the mean face of a body.
constexpr double kFacesOfCube = 6.0;
// Smallest spread of an area, relative to its largest, in which a slope means something.
constexpr double kThin = 1e-12;

/// A corner of a facet as the plane sees it.
struct Corner {
  Vector2d at;
  double overlap;
};

/// Integrals over the area below the plane.
struct AreaSums {
  double area = 0, overlap = 0, square = 0;
  Vector2d first = Vector2d::Zero(), overlap_first = Vector2d::Zero();
  Matrix2d second = Matrix2d::Zero();

  void add(const Corner& a, const Corner& b, const Corner& c) {
    const Vector2d u = b.at - a.at, v = c.at - a.at;
    // Positive where the facet looks at the plane; clockwise as seen from above.
    const double own = 0.5 * (u.y() * v.x() - u.x() * v.y());
    if (own == 0.0) return;
    area += own;
    // The middles of the edges integrate squares exactly.
    for (const auto& [p, q] : {std::pair(&a, &b), std::pair(&b, &c), std::pair(&c, &a)}) {
      const Vector2d x = 0.5 * (p->at + q->at);
      const double d = 0.5 * (p->overlap + q->overlap);
      const double weight = own / 3.0;
      first += weight * x;
      second += weight * x * x.transpose();
      overlap += weight * d;
      overlap_first += weight * d * x;
      square += weight * d * d;
    }
  }

  /// The part of a triangle that is below the plane.
  void add_below(const std::array<Corner, 3>& triangle) {
    std::array<Corner, 4> kept;
    std::size_t count = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Corner& one = triangle[k];
      const Corner& next = triangle[(k + 1) % 3];
      if (one.overlap > 0.0) kept[count++] = one;
      if ((one.overlap > 0.0) == (next.overlap > 0.0)) continue;
      const double share = one.overlap / (one.overlap - next.overlap);
      kept[count++] = {one.at + share * (next.at - one.at), 0.0};
    }
    for (std::size_t k = 2; k < count; ++k) add(kept[0], kept[k - 1], kept[k]);
  }
};

}  // namespace

void find_sphere_spots(const ContactMesh& mesh, const Vector3d& centre, double radius,
                       std::span<ContactSpot> spots) {
  std::array<ContactMesh::Nearest, ContactMesh::kMostColours> places;
  const auto count = static_cast<std::size_t>(mesh.num_colours());
  mesh.nearest_of_colours(centre, kReach * radius, places);
  const auto is_open = [](const ContactMesh::Nearest& n) {
    return n.facet < 0 || std::isinf(n.distance);
  };
  const bool is_alone = std::all_of(places.begin(), places.begin() + mesh.num_colours(), is_open);
  // Far away, or deep inside: the gap is that from the nearest place.
  const ContactMesh::Nearest only = is_alone ? mesh.nearest(centre) : ContactMesh::Nearest();
  for (std::size_t k = 0; k < count; ++k) {
    const bool is_first = is_alone && k == 0;
    const ContactMesh::Nearest& place = is_first ? only : places[k];
    ContactSpot& spot = spots[k];
    spot = {};
    spot.gap = HUGE_VAL;
    spot.place = centre;
    if (place.facet < 0) continue;
    spot.normal = place.normal;
    spot.place = place.at;
    if (std::isinf(place.distance)) continue;
    spot.gap = place.distance - radius;
    spot.place += 0.5 * spot.gap * spot.normal;
  }
}

namespace {

/// What a mesh has below a plane.
struct BelowPlane {
  AreaSums sums;
  double lowest = HUGE_VAL;  // height of its lowest corner [m]
  Vector3d lowest_at = Vector3d::Zero();
};

/// @param height of the mesh's origin above the plane, @param n normal of the plane, @param u,v
/// axes of the plane; axes of the mesh
BelowPlane below_plane(const ContactMesh& mesh, double height, const Vector3d& n, const Vector3d& u,
                       const Vector3d& v) {
  BelowPlane out;
  mesh.tree().search(
      [&](const AlignedBox3d& box) {
        return height + n.dot(box.center()) - 0.5 * n.cwiseAbs().dot(box.sizes());
      },
      [&](double least, std::uint32_t /*marks*/) { return least < std::max(0.0, out.lowest); },
      [&](int item) {
        const auto& corners = mesh.corners(static_cast<std::size_t>(item));
        std::array<Corner, 3> seen;
        double own = HUGE_VAL;
        for (std::size_t k = 0; k < 3; ++k) {
          const double above = height + n.dot(corners[k]);
          seen[k] = {{u.dot(corners[k]), v.dot(corners[k])}, -above};
          own = std::min(own, above);
          if (above >= out.lowest) continue;
          out.lowest = above;
          out.lowest_at = corners[k];
        }
        // Of closed surfaces, what looks away from the plane is subtracted: the columns above what
        // looks at it end there.
        const Vector3d away = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        if (own < 0.0 && (mesh.is_closed() || away.dot(n) < 0.0)) out.sums.add_below(seen);
      });
  return out;
}

}  // namespace

void find_plane_spots(const ContactMesh& mesh, const Vector3d& normal, const Vector3d& r,
                      const Matrix3d& R, std::span<ContactSpot, 4> spots) {
  const Vector3d e = normal.unitOrthogonal(), f = normal.cross(e);
  const Vector3d u = R.transpose() * e, v = R.transpose() * f;
  const BelowPlane below = below_plane(mesh, normal.dot(r), R.transpose() * normal, u, v);
  const AreaSums& sums = below.sums;
  const bool touches = sums.area > 0.0 && sums.overlap > 0.0;
  const Vector2d centre = touches ? Vector2d(sums.first / sums.area)
                                  : Vector2d(u.dot(below.lowest_at), v.dot(below.lowest_at));
  const double mean = touches ? sums.overlap / sums.area : -std::max(0.0, below.lowest);
  Matrix2d root = Matrix2d::Zero();
  Vector2d slope = Vector2d::Zero();
  double share = 0.0, held = 0.0;
  if (touches) {
    const Matrix2d spread = sums.second / sums.area - centre * centre.transpose();
    const Vector2d common = sums.overlap_first / sums.area - mean * centre;
    root = symmetric_root(spread);
    const bool has_slope = spread.determinant() > kThin * spread.trace() * spread.trace();
    if (has_slope) slope = spread.inverse() * common;
    share = sums.area * kFacesOfCube / mesh.area();
    held = 2.0 * share * (sums.square / sums.area - mean * mean - slope.dot(spread * slope));
  }
  static constexpr double kU[] = {1, -1, -1, 1}, kV[] = {1, 1, -1, -1};
  for (std::size_t k = 0; k < 4; ++k) {
    ContactSpot& spot = spots[k];
    const Vector2d out = root * Vector2d(kU[k], kV[k]);
    const double overlap = mean + slope.dot(out);
    const Vector2d at = centre + out + Vector2d(e.dot(r), f.dot(r));
    spot.normal = normal;
    spot.gap = -overlap;
    spot.share = share;
    spot.held = k == 0 ? held : 0.0;
    spot.place = at.x() * e + at.y() * f - 0.5 * overlap * normal;
  }
}

}  // namespace buckens::loads
