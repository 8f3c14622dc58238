// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/contact_pair.h"

#include <algorithm>

#include "buckens/loads/box_manifold.h"
#include "buckens/loads/contact_mesh.h"
#include "buckens/loads/cylinder_spots.h"
#include "buckens/loads/line_spots.h"
#include "buckens/loads/mesh_on_mesh.h"
#include "buckens/loads/mesh_spots.h"
#include "buckens/loads/shape_distance.h"

namespace buckens::loads {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using ShapeKind = ContactShape::Kind;

namespace {

constexpr std::size_t kRimPoints = 4;
// Sine of the tilt below which the lowest point of a rim says nothing.
constexpr double kUpright = 1e-6;
// How often the lowest point of a rim is looked for again where a surface is curved.
constexpr int kRimSearches = 2;

/// Unit vector down a disc with this axis; zero where the disc is level.
Vector3d downhill(const Vector3d& normal, const Vector3d& axis) {
  const Vector3d down = axis * axis.dot(normal) - normal;
  const double tilt = down.norm();
  return tilt > kUpright ? Vector3d(down / tilt) : Vector3d(Vector3d::Zero());
}
}  // namespace

const char* to_string(ShapeKind kind) {
  static constexpr const char* kNames[] = {"plane",   "sphere",   "socket", "bore",
                                           "capsule", "cylinder", "box",    "mesh"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::span<const ContactPair::Kinds> ContactPair::all() {
  using enum ContactShape::Kind;
  static constexpr Kinds kAll[] = {
      {plane, sphere},      {sphere, sphere},    {socket, sphere}, {bore, sphere},
      {capsule, sphere},    {cylinder, sphere},  {box, sphere},    {plane, capsule},
      {plane, cylinder},    {plane, box},        {bore, cylinder}, {capsule, capsule},
      {box, capsule},       {cylinder, capsule}, {box, box},       {box, cylinder},
      {cylinder, cylinder}, {mesh, sphere},      {mesh, capsule},  {mesh, cylinder},
      {mesh, box},          {plane, mesh},       {mesh, mesh}};
  return kAll;
}

bool ContactPair::knows(ShapeKind first, ShapeKind second) {
  const std::span<const Kinds> known = all();
  return std::find(known.begin(), known.end(), Kinds{first, second}) != known.end();
}

ContactPair::ContactPair(const ContactShape& first, const ContactShape& second)
    : first_(first), second_(second) {
  const bool on_rims = (first.kind == ShapeKind::plane || first.kind == ShapeKind::mesh) &&
                       second.kind == ShapeKind::cylinder;
  radius_ = second.kind == ShapeKind::box || on_rims ? 0.0 : second.radius;
  const bool has_ends = second.kind == ShapeKind::cylinder || second.kind == ShapeKind::capsule;
  const bool by_volume =
      second.kind == ShapeKind::cylinder && touches_cylinder_by_volume(first.kind);
  if (by_volume) {
    num_spots_ = kCylinderSpots;
  } else if (second.kind == ShapeKind::mesh) {
    num_spots_ = first.kind == ShapeKind::mesh ? static_cast<int>(kMeshSpots) : 4;
  } else if (first.kind == ShapeKind::mesh && second.kind == ShapeKind::sphere) {
    num_spots_ = first.mesh->num_colours();
  } else if (second.kind == ShapeKind::box) {
    num_spots_ = first.kind == ShapeKind::box || second.flat >= 0 ? 4 : 8;
  } else if (has_ends) {
    num_spots_ = on_rims ? 2 * static_cast<int>(kRimPoints) : 2;
  }
}

void ContactPair::rim_points(const Vector3d& r, const Matrix3d& R,
                             std::span<ContactSpot> spots) const {
  static constexpr std::array<double, kRimPoints> kCosine = {1.0, 0.0, -1.0, 0.0},
                                                  kSine = {0.0, 1.0, 0.0, -1.0};
  const Vector3d axis = R * second_.axis;
  std::size_t next = 0;
  for (const double end : {1.0, -1.0}) {
    const Vector3d centre = r + end * second_.half_length * axis;
    // Downhill within the end; others in equal distances from there on, so that an upright cylinder
    // stands on both ends of any two diameters alike.
    Vector3d down = downhill(normal_at_rim(centre, axis), axis);
    if (down.isZero(0.0)) down = R * second_.axis.unitOrthogonal();
    const Vector3d across = axis.cross(down);
    for (std::size_t k = 0; k < kRimPoints; ++k) {
      spots[next++].place = centre + second_.radius * (kCosine[k] * down + kSine[k] * across);
    }
  }
}

Vector3d ContactPair::normal_at_rim(const Vector3d& centre, const Vector3d& axis) const {
  if (first_.kind == ShapeKind::plane) return first_.axis;
  // From the nearest place of the centre to that of the lowest point of the rim.
  Vector3d normal = first_.mesh->nearest(centre).normal;
  for (int k = 0; k < kRimSearches; ++k) {
    const Vector3d lowest = centre + second_.radius * downhill(normal, axis);
    normal = first_.mesh->nearest(lowest).normal;
  }
  return normal;
}

void ContactPair::centres(const Vector3d& r, const Matrix3d& R,
                          std::span<ContactSpot> spots) const {
  if (num_spots_ == 1) {
    spots[0].place = r;
    return;
  }
  if (second_.kind == ShapeKind::box) {
    int corner = 0;
    for (ContactSpot& spot : spots) {
      Vector3d at = second_.half;
      int bit = 1;
      for (int axis = 0; axis < 3; ++axis) {
        if (axis == second_.flat) {
          at[axis] = 0.0;
          continue;
        }
        if ((corner & bit) != 0) at[axis] = -at[axis];
        bit *= 2;
      }
      spot.place = r + R * at;
      ++corner;
    }
    return;
  }
  if (num_spots_ == 2) {
    const Vector3d half = R * second_.axis * second_.half_length;
    spots[0].place = r + half;
    spots[1].place = r - half;
    return;
  }
  rim_points(r, R, spots);
}

void ContactPair::find(const Vector3d& r, const Matrix3d& R, std::span<ContactSpot> all) const {
  if (first_.kind == ShapeKind::box && second_.kind == ShapeKind::box) {
    return find_box_spots(first_, second_, r, R, all.first<4>());
  }
  if (second_.kind == ShapeKind::capsule && touches_along_lines(first_.kind)) {
    return find_line_spots(first_, second_, r, R, all.first<2>());
  }
  if (second_.kind == ShapeKind::cylinder && touches_cylinder_by_volume(first_.kind)) {
    return find_cylinder_spots(first_, second_, r, R, all.first<kCylinderSpots>());
  }
  if (second_.kind == ShapeKind::mesh && first_.kind == ShapeKind::mesh) {
    return find_mesh_spots(*first_.mesh, *second_.mesh, r, R, all.first<kMeshSpots>());
  }
  if (second_.kind == ShapeKind::mesh) {
    return find_plane_spots(*second_.mesh, first_.axis, r, R, all.first<4>());
  }
  const std::span<ContactSpot> spots = all.first(static_cast<std::size_t>(num_spots_));
  if (first_.kind == ShapeKind::mesh && second_.kind == ShapeKind::sphere) {
    return find_sphere_spots(*first_.mesh, r, radius_, spots);
  }
  centres(r, R, spots);
  for (ContactSpot& spot : spots) {
    const double away = distance_from(first_, spot.place, spot.normal);
    spot.gap = away - radius_;
    spot.place -= (0.5 * (away + radius_)) * spot.normal;
  }
}

}  // namespace buckens::loads
