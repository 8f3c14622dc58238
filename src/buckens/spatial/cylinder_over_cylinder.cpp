// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "buckens/spatial/cylinder_touch.h"
#include "buckens/spatial/place_finders.h"
#include "buckens/spatial/segment_pair.h"

namespace buckens::spatial {

using Eigen::Vector3d;

namespace {

// How many times faster than the bodies a place may be to be followed, and the speed of bodies that
// hardly move, in sizes per second.
constexpr double kRaces = 20.0, kSlowest = 1.0;

/// Whether a place runs along both bodies faster than steps can follow, as where sides come to lie
/// along each other. It strikes, but does not hold: a closed row would ask throughout the step for
/// the acceleration that belongs to the place for an instant.
bool races(const MarkerMotion& F, const MarkerMotion& M, double size, const TouchPlace& place) {
  const auto speed_over = [&](const MarkerMotion& body) {
    return (place.place_rate - body.v - body.w.cross(place.place - body.p)).norm();
  };
  const double speed = std::min(speed_over(F), speed_over(M));
  const double motion = place.velocity(F, M).norm() + size * (M.w - F.w).norm();
  return speed > kRaces * std::max(motion, size * kSlowest);
}

/// Where both sides cross; beyond an end of either, its rim on the side of the other.
void set_sides(const TouchSurface& first, const MarkerMotion& F, const TouchSurface& second,
               const MarkerMotion& M, TouchPlace& out) {
  const Vector3d own = first.half_length * first.axis, other = second.half_length * second.axis;
  const Vector3d r = M.p - F.p, a = F.R * own, b = M.R * other;
  const auto at = NearestOfSegments::of(r, a, b);
  const Vector3d between = r + at.on_second * b - at.on_first * a;
  const double gap = between.norm() - first.radius - second.radius;
  const auto is_past = [&](double along, const TouchSurface& cylinder) {
    return std::abs(along) >= 1.0 || -gap > (1.0 - std::abs(along)) * cylinder.half_length;
  };
  if (is_past(at.on_second, second)) {
    const Vector3d axis = M.R * second.axis;
    set_rim_over_side(first, F, Rim::of(second, at.on_second < 0.0 ? -1.0 : 1.0), M, 1.0, out);
    return leave_to_rim(std::max(std::abs(gap), std::abs(axis.dot(between))), axis, second.radius,
                        out);
  }
  if (is_past(at.on_first, first)) {
    const Vector3d axis = F.R * first.axis;
    set_rim_over_side(second, M, Rim::of(first, at.on_first < 0.0 ? -1.0 : 1.0), F, 1.0, out);
    turn_round(out);
    return leave_to_rim(std::max(std::abs(gap), std::abs(axis.dot(between))), axis, first.radius,
                        out);
  }
  set_segments({Vector3d::Zero(), own, first.radius}, F, {Vector3d::Zero(), other, second.radius},
               M, F.R * first.axis.unitOrthogonal(), out);
  if (races(F, M, std::min(first.radius, second.radius), out)) out.touches = false;
}

/// What a cylinder of M touches another one with: its rims, and points of its ends.
template <class Add>
void add_ends(const TouchSurface& under, const TouchSurface& over, Add add) {
  for (const double end : {1.0, -1.0}) {
    const Rim rim = Rim::of(over, end);
    add([=](const MarkerMotion& F, const MarkerMotion& M, TouchPlace& place) {
      set_rim_over_face(under, 0, F, rim, M, place);
    });
    for (const double towards : {1.0, -1.0}) {
      add([=](const MarkerMotion& F, const MarkerMotion& M, TouchPlace& place) {
        set_rim_over_side(under, F, rim, M, towards, place);
      });
    }
  }
  for (const auto& points : points_on_ends(over)) add(nearer_point(under, points));
}

}  // namespace

TouchFinders cylinder_over_cylinder(const TouchSurface& first, const TouchSurface& second) {
  TouchFinders out;
  const auto add = [&]<class Look>(Look look) {
    out.push_back(std::make_shared<FoundBy<Look>>(first, second, std::move(look)));
  };
  add_ends(first, second, add);
  add_ends(second, first, [&](auto look) { add(turned(std::move(look))); });
  add([=](const MarkerMotion& F, const MarkerMotion& M, TouchPlace& place) {
    set_sides(first, F, second, M, place);
  });
  for (const double end : {1.0, -1.0}) {
    for (const double other : {1.0, -1.0}) {
      for (const double towards : {1.0, -1.0}) {
        add([one = Rim::of(first, end), rim = Rim::of(second, other), towards](
                const MarkerMotion& F, const MarkerMotion& M, TouchPlace& place) {
          set_rim_over_rim(one, F, rim, M, towards, place);
        });
      }
    }
  }
  return out;
}

}  // namespace buckens::spatial
