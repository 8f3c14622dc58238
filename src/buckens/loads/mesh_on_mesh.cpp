// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/mesh_on_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "buckens/loads/surface_points.h"
#include "buckens/loads/symmetric_root.h"

namespace buckens::loads {

using Eigen::AlignedBox3d;
using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

// A sixth of a surface stands for the mean face of a body, as on a plane.
constexpr double kFacesOfMesh = 6.0;
// Up to this ratio of their surfaces both have springs: a corner of either meets those of the
// other between their points.
constexpr double kAlike = 2.25;
// Share of all forces below which a way has none but by rounding.
constexpr double kNoForceOfWay = 1e-14;

constexpr std::size_t kWays = 6, kSpotsOfWay = kMeshSpots / kWays;

/// Sums of the forces along one way, per stiffness of an area.
struct WaySums {
  double load = 0;    // without regard to direction
  double square = 0;  // twice the energy
  Vector3d force = Vector3d::Zero(), moment = Vector3d::Zero(), first = Vector3d::Zero();
  Matrix2d second = Matrix2d::Zero();
};

Vector2d across_way(std::size_t axis, const Vector3d& x) {
  return {x[static_cast<Eigen::Index>((axis + 1) % 3)],
          x[static_cast<Eigen::Index>((axis + 2) % 3)]};
}

/// What two surfaces do to each other, in axes of the first.
struct Touch {
  std::array<WaySums, kWays> ways;
  double load = 0;
  double gap = HUGE_VAL;  // least distance of a point
  Vector3d place = Vector3d::Zero(), normal = Vector3d::UnitZ();

  /// @param x halfway between both surfaces, @param n towards the second
  void add(const Vector3d& x, const Vector3d& n, double overlap, double area) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double along = n[static_cast<Eigen::Index>(axis)];
      const double force = area * overlap * along * along;
      if (force == 0.0) continue;
      WaySums& way = ways[2 * axis + (along < 0.0 ? 1 : 0)];
      way.load += force;
      way.square += force * overlap;
      way.force += force * n;
      way.moment += force * x.cross(n);
      way.first += force * x;
      const Vector2d y = across_way(axis, x);
      way.second += force * y * y.transpose();
    }
    load += area * overlap;
  }
};

/// Points of one mesh at the surface of the other.
/// @param r, R of the mesh that has the points, in axes of the other
/// @param found (place, normal of the other's surface, distance, area), axes of the other
template <class Found>
void look_for_points(const ContactMesh& with_points, const ContactMesh& other, const Vector3d& r,
                     const Matrix3d& R, double& least, Found&& found) {
  const SurfacePoints& surface = with_points.springs();
  surface.tree().search(
      [&](const AlignedBox3d& box) {
        // Distances change by no more than the way.
        return other.nearest(r + R * box.center()).distance - 0.5 * box.diagonal().norm();
      },
      [&](double bound, std::uint32_t /*marks*/) { return bound < std::max(0.0, least); },
      [&](int item) {
        const SurfacePoints::Point& point = surface.points()[static_cast<std::size_t>(item)];
        const Vector3d x = r + R * point.at;
        const ContactMesh::Nearest near = other.nearest(x);
        found(x, near.normal, near.distance, point.area);
      });
}

Touch touch_between(const ContactMesh& first, const ContactMesh& second, const Vector3d& r,
                    const Matrix3d& R) {
  Touch out;
  const double ratio = first.area() / second.area();
  const bool on_both = ratio < kAlike && ratio > 1.0 / kAlike;
  const double share = on_both ? 0.5 : 1.0;
  const auto take = [&](const Vector3d& x, const Vector3d& n, double distance, double area) {
    if (distance < out.gap) {
      out.gap = distance;
      out.place = x;
      out.normal = n;
    }
    if (distance < 0.0) out.add(x, n, -distance, share * area);
  };
  if (on_both || ratio >= 1.0) {
    look_for_points(second, first, r, R, out.gap,
                    [&](const Vector3d& x, const Vector3d& n, double distance, double area) {
                      take(x - 0.5 * distance * n, n, distance, area);
                    });
  }
  if (on_both || ratio < 1.0) {
    look_for_points(first, second, -(R.transpose() * r), R.transpose(), out.gap,
                    [&](const Vector3d& x, const Vector3d& n, double distance, double area) {
                      take(r + R * (x - 0.5 * distance * n), -(R * n), distance, area);
                    });
  }
  return out;
}

/// @param per_area 4/Ā [1/m²]
void set_spots_of_way(const WaySums& sums, std::size_t axis, double per_area,
                      std::span<ContactSpot, kSpotsOfWay> spots) {
  const double force = sums.force.norm();
  const double overlap = sums.square / force;
  const Vector3d centre = sums.first / sums.load;
  const Vector2d middle = across_way(axis, centre);
  const Matrix2d root = symmetric_root(sums.second / sums.load - middle * middle.transpose());
  const Vector3d couple = (sums.moment - centre.cross(sums.force)) / force;
  // Three points around the centre that have the spread of the forces.
  static const std::array<Vector2d, kSpotsOfWay> kAround = {
      Vector2d(std::sqrt(2.0), 0.0), Vector2d(-std::sqrt(0.5), std::sqrt(1.5)),
      Vector2d(-std::sqrt(0.5), -std::sqrt(1.5))};
  for (std::size_t k = 0; k < kSpotsOfWay; ++k) {
    const Vector2d out = root * kAround[k];
    ContactSpot& spot = spots[k];
    spot.place = centre;
    spot.place[static_cast<Eigen::Index>((axis + 1) % 3)] += out.x();
    spot.place[static_cast<Eigen::Index>((axis + 2) % 3)] += out.y();
    spot.normal = sums.force / force;
    spot.gap = -overlap;
    spot.share = per_area * force / (kSpotsOfWay * overlap);
    spot.couple = couple;
  }
}

}  // namespace

void find_mesh_spots(const ContactMesh& first, const ContactMesh& second, const Vector3d& r,
                     const Matrix3d& R, std::span<ContactSpot, kMeshSpots> spots) {
  const Touch touch = touch_between(first, second, r, R);
  const double per_area = 4.0 * kFacesOfMesh / std::min(first.area(), second.area());
  // What does not touch closes where the surfaces are nearest; beside others that do, not at all.
  ContactSpot idle;
  idle.place = touch.place;
  idle.normal = touch.normal;
  idle.gap = touch.load > 0.0 ? HUGE_VAL : std::max(0.0, touch.gap);
  std::fill(spots.begin(), spots.end(), idle);
  for (std::size_t way = 0; way < kWays; ++way) {
    const WaySums& sums = touch.ways[way];
    if (!(sums.load > kNoForceOfWay * touch.load) || !(sums.force.norm() > 0.0)) continue;
    set_spots_of_way(sums, way / 2, per_area,
                     std::span<ContactSpot, kSpotsOfWay>(&spots[way * kSpotsOfWay], kSpotsOfWay));
  }
}

}  // namespace buckens::loads
