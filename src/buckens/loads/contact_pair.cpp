// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/contact_pair.h"

#include <algorithm>
#include <cmath>

#include "buckens/loads/box_manifold.h"
#include "buckens/loads/contact_mesh.h"
#include "buckens/loads/mesh_spots.h"

namespace buckens::loads {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

using ShapeKind = ContactShape::Kind;

constexpr int kRimPoints = 4;
// Sine of the tilt below which the lowest point of a rim says nothing.
constexpr double kUpright = 1e-6;
// Square of the sine between capsules that count as parallel.
constexpr double kParallel = 1e-12;

/// Length and direction of a vector; any direction where it vanishes.
double length_of(const Vector3d& v, const Vector3d& axis, Vector3d& direction) {
  const double length = v.norm();
  direction = length > 0.0 ? Vector3d(v / length) : axis.unitOrthogonal();
  return length;
}

double from_cylinder(const ContactShape& shape, const Vector3d& point, Vector3d& normal) {
  const double along = shape.axis.dot(point);
  Vector3d radial;
  const double beside = length_of(point - along * shape.axis, shape.axis, radial) - shape.radius;
  const double beyond = std::abs(along) - shape.half_length;
  const Vector3d end = along < 0.0 ? Vector3d(-shape.axis) : shape.axis;
  if (beside > 0.0 && beyond > 0.0) {  // nearest to the rim
    const double out = std::hypot(beside, beyond);
    normal = (beside * radial + beyond * end) / out;
    return out;
  }
  normal = beside > beyond ? radial : end;
  return std::max(beside, beyond);
}

double from_box(const ContactShape& shape, const Vector3d& point, Vector3d& normal) {
  Vector3d beyond = point.cwiseAbs() - shape.half;
  if (shape.flat >= 0) beyond[shape.flat] = -HUGE_VAL;
  int most = 0;
  const double inside = beyond.maxCoeff(&most);
  const Vector3d side = point.unaryExpr([](double x) { return x < 0.0 ? -1.0 : 1.0; });
  if (inside <= 0.0) {
    normal = side[most] * Vector3d::Unit(most);
    return inside;
  }
  const Vector3d out = beyond.cwiseMax(0.0).cwiseProduct(side);
  normal = out.normalized();
  return out.norm();
}

/// Parameter in −1 … 1 of the point of a segment that is next to the other segment; halfway along
/// where they run side by side.
/// @param r from the middle of the first to that of the second, @param a,b half segments
double nearest_on_second(const Vector3d& r, const Vector3d& a, const Vector3d& b) {
  const double aa = a.squaredNorm(), bb = b.squaredNorm(), ab = a.dot(b);
  const double ar = a.dot(r), br = b.dot(r);
  const double det = aa * bb - ab * ab;
  if (det <= kParallel * aa * bb) {
    // Both ends of the first as parameters of the second: the overlap's middle, or the nearer end.
    const double low = (-br - std::abs(ab)) / bb, high = (-br + std::abs(ab)) / bb;
    return 0.5 * (std::clamp(low, -1.0, 1.0) + std::clamp(high, -1.0, 1.0));
  }
  // Minimum of |r + t b − s a|, then clamped in turn, which is exact for two segments.
  const double s = std::clamp((bb * ar - ab * br) / det, -1.0, 1.0);
  const double t = std::clamp((ab * s - br) / bb, -1.0, 1.0);
  const double s_again = std::clamp((ab * t + ar) / aa, -1.0, 1.0);
  return std::clamp((ab * s_again - br) / bb, -1.0, 1.0);
}

}  // namespace

const char* to_string(ShapeKind kind) {
  static constexpr const char* kNames[] = {"plane",   "sphere",   "socket", "bore",
                                           "capsule", "cylinder", "box",    "mesh"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::span<const ContactPair::Kinds> ContactPair::all() {
  using enum ContactShape::Kind;
  static constexpr Kinds kAll[] = {{plane, sphere}, {sphere, sphere},  {socket, sphere},
                                   {bore, sphere},  {capsule, sphere}, {cylinder, sphere},
                                   {box, sphere},   {plane, capsule},  {plane, cylinder},
                                   {plane, box},    {bore, cylinder},  {capsule, capsule},
                                   {box, box},      {mesh, sphere},    {mesh, capsule},
                                   {mesh, box},     {plane, mesh}};
  return kAll;
}

bool ContactPair::knows(ShapeKind first, ShapeKind second) {
  const std::span<const Kinds> known = all();
  return std::find(known.begin(), known.end(), Kinds{first, second}) != known.end();
}

ContactPair::ContactPair(const ContactShape& first, const ContactShape& second)
    : first_(first), second_(second) {
  const bool on_rims = first.kind == ShapeKind::plane && second.kind == ShapeKind::cylinder;
  radius_ = second.kind == ShapeKind::box || on_rims ? 0.0 : second.radius;
  const bool has_ends = second.kind == ShapeKind::cylinder ||
                        (second.kind == ShapeKind::capsule && first.kind != ShapeKind::capsule);
  if (second.kind == ShapeKind::mesh) {
    num_spots_ = 4;
  } else if (first.kind == ShapeKind::mesh && second.kind == ShapeKind::sphere) {
    num_spots_ = first.mesh->num_colours();
  } else if (second.kind == ShapeKind::box) {
    num_spots_ = first.kind == ShapeKind::box || second.flat >= 0 ? 4 : 8;
  } else if (has_ends) {
    num_spots_ = on_rims ? 2 * kRimPoints : 2;
  }
}

void ContactPair::rim_points(const Vector3d& r, const Matrix3d& R,
                             std::span<ContactSpot> spots) const {
  const Vector3d axis = R * second_.axis;
  // Downhill within the ends; others in equal distances from there on, so that an upright cylinder
  // stands on both ends of any two diameters alike.
  Vector3d down = axis * axis.dot(first_.axis) - first_.axis;
  const double tilt = down.norm();
  if (tilt > kUpright) {
    down /= tilt;
  } else {
    down = R * second_.axis.unitOrthogonal();
  }
  const Vector3d across = axis.cross(down);
  for (int k = 0; k < num_spots_; ++k) {
    const double end = k < kRimPoints ? 1.0 : -1.0;
    static constexpr double kCosine[] = {1.0, 0.0, -1.0, 0.0}, kSine[] = {0.0, 1.0, 0.0, -1.0};
    const int place = k % kRimPoints;
    spots[static_cast<std::size_t>(k)].place =
        r + end * second_.half_length * axis +
        second_.radius * (kCosine[place] * down + kSine[place] * across);
  }
}

void ContactPair::centres(const Vector3d& r, const Matrix3d& R,
                          std::span<ContactSpot> spots) const {
  if (num_spots_ == 1) {
    spots[0].place = r;
    if (second_.kind != ShapeKind::capsule) return;
    const Vector3d half = R * second_.axis * second_.half_length;
    spots[0].place += nearest_on_second(r, first_.axis * first_.half_length, half) * half;
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

double ContactPair::distance(const Vector3d& point, Vector3d& normal) const {
  const Vector3d& axis = first_.axis;
  switch (first_.kind) {
    case ShapeKind::plane:
      normal = axis;
      return axis.dot(point);
    case ShapeKind::sphere:
      return length_of(point, axis, normal) - first_.radius;
    case ShapeKind::socket:
    case ShapeKind::bore: {
      const bool is_bore = first_.kind == ShapeKind::bore;
      const double out =
          length_of(is_bore ? Vector3d(point - axis * axis.dot(point)) : point, axis, normal);
      normal = -normal;
      return first_.radius - out;
    }
    case ShapeKind::capsule: {
      const double along = std::clamp(axis.dot(point), -first_.half_length, first_.half_length);
      return length_of(point - along * axis, axis, normal) - first_.radius;
    }
    case ShapeKind::cylinder:
      return from_cylinder(first_, point, normal);
    case ShapeKind::box:
      return from_box(first_, point, normal);
    case ShapeKind::mesh: {
      const ContactMesh::Nearest place = first_.mesh->nearest(point);
      normal = place.normal;
      return place.distance;
    }
  }
  return HUGE_VAL;
}

void ContactPair::find(const Vector3d& r, const Matrix3d& R, Spots& all) const {
  if (first_.kind == ShapeKind::box && second_.kind == ShapeKind::box) {
    return find_box_spots(first_, second_, r, R, std::span(all).first<4>());
  }
  if (second_.kind == ShapeKind::mesh) {
    return find_plane_spots(*second_.mesh, first_.axis, r, R, std::span(all).first<4>());
  }
  const std::span<ContactSpot> spots(all.data(), static_cast<std::size_t>(num_spots_));
  if (first_.kind == ShapeKind::mesh && second_.kind == ShapeKind::sphere) {
    return find_sphere_spots(*first_.mesh, r, radius_, spots);
  }
  centres(r, R, spots);
  for (ContactSpot& spot : spots) {
    const double away = distance(spot.place, spot.normal);
    spot.gap = away - radius_;
    spot.place -= (0.5 * (away + radius_)) * spot.normal;
  }
}

}  // namespace buckens::loads
