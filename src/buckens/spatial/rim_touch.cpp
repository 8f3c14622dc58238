// SPDX-License-Identifier: Apache-2.0
#include "buckens/spatial/rim_touch.h"

#include <algorithm>
#include <cmath>

#include "buckens/spatial/rim_point.h"
#include "buckens/spatial/ring_near_line.h"
#include "buckens/spatial/whole_overlap.h"

namespace buckens::spatial {

using Eigen::Vector3d;

namespace {

// Sine of the tilt below which the lowest point of a rim over a face says nothing.
constexpr double kLevelRim = 1e-6;
// Share of the radius by which the place on one side may be further away than that on the other;
// else the row stands for the latter, too, so that it does not leave what touches.
constexpr double kSidesApart = 1e-4;
// Share of the radius by which a place past the end of a side is still that of its rim, so that
// both rows are closed when one takes over; from there on it is open.
constexpr double kPastEnd = 1e-3;
// Cosine between the axis and what is about at right angles to it.
constexpr double kAcross = 0.1;
// Share of the size by which a place may lie beyond the border of a face or side.
constexpr double kOnBorder = 1e-9;

/// A point of a line that moves with `owner`.
struct LinePoint {
  const MarkerMotion& owner;
  Vector3d middle, along;
  double at;

  Vector3d x() const { return middle + at * along; }
  Vector3d rate() const { return owner.v + owner.w.cross(x() - owner.p); }
  Vector3d along_rate() const { return owner.w.cross(along); }
};

/// A rim's point and one of a line, which are nearest to each other, and their rates.
struct NearPoints {
  MovingPoint on_line, on_rim;
  Vector3d tangent_rate;

  /// @param is_free the place on the line moves along it, too
  NearPoints(const LinePoint& line, const RimPoint& rim, bool is_free)
      : on_line{line.x(), line.rate()}, on_rim{rim.place(), rim.rate()} {
    const Vector3d d = on_rim.x - on_line.x, between = on_rim.rate - on_line.rate;
    const double r2 = rim.tangent.dot(between) + rim.turning().dot(d);
    const double down = rim.radius - rim.radial.dot(d);
    double around = 0.0;
    if (is_free) {
      const double k = line.along.dot(rim.tangent);
      const double r1 = line.along.dot(between) + line.along_rate().dot(d);
      around = rim.share(k * r1 - r2, down - rim.radius * k * k);
      on_line.rate += (rim.radius * k * around + r1) * line.along;
    } else {
      around = rim.share(-r2, down);
    }
    on_rim.rate += rim.radius * around * rim.tangent;
    tangent_rate = rim.turning() - around * rim.radial;
  }
};

/// The place on a segment next to the middle of a rim that is far away from it.
/// @return whether it is
bool set_far_rim(const LinePoint& middle, double half_length, double inner, const RimPoint& rim,
                 TouchPlace& out) {
  LinePoint near = middle;
  near.at = middle.along.dot(rim.centre - middle.middle);
  const bool is_free = std::abs(near.at) <= half_length;
  near.at = std::clamp(near.at, -half_length, half_length);
  const Vector3d d = rim.centre - near.x();
  const double reach = rim.radius + inner + std::min(rim.radius, half_length);
  if (d.squaredNorm() < reach * reach) return false;
  MovingPoint x{near.x(), near.rate()};
  const MovingPoint c{rim.centre, rim.centre_rate()};
  if (is_free) x.rate += (near.along.dot(c.rate - x.rate) + near.along_rate().dot(d)) * near.along;
  set_points(x, c, is_free ? inner : 0.0, out);
  return true;
}

/// Across both an edge and a rim: with the sign of the gap where that leads out of both bodies.
enum class Across { not_set, beside, out_of_both };
/// @return not_set: their points are apart, or there is no such direction
Across set_across(const SharpEdge& edge, const LinePoint& line, const RimPoint& rim,
                  const NearPoints& points, TouchPlace& out) {
  Crossing crossing(line.along, line.along_rate(), rim.tangent, points.tangent_rate);
  const Vector3d one = line.owner.R * edge.beyond[0], other = line.owner.R * edge.beyond[1];
  if (!crossing.lead(one + other - rim.axis - rim.radial)) return Across::not_set;
  const bool leads_out =
      rim.sees(crossing.normal) &&
      std::min(crossing.normal.dot(one), crossing.normal.dot(other)) > -kOutOfCone;
  if (!crossing.set(points.on_line, points.on_rim, leads_out, rim.radius, out)) {
    return Across::not_set;
  }
  return leads_out ? Across::out_of_both : Across::beside;
}

/// How far a point is over the plane of a face or an end, and whether it is over the face.
struct OverFace {
  double height = 0;
  bool is_over = false;

  /// @param normal,x in axes of the solid
  OverFace(const TouchSurface& solid, int axis, const Vector3d& normal, const Vector3d& x) {
    double inside = HUGE_VAL;  // from the border of the face
    if (solid.kind == TouchSurface::Kind::box) {
      height = normal.dot(x) - solid.half[axis];
      for (const int k : {(axis + 1) % 3, (axis + 2) % 3}) {
        inside = std::min(inside, solid.half[k] - std::abs(x[k]));
      }
    } else {
      height = normal.dot(x) - solid.half_length;
      inside = solid.radius - (x - normal.dot(x) * normal).norm();
    }
    is_over = inside >= -kOnBorder * least_extent(solid);
  }
};

}  // namespace

SharpEdge SharpEdge::of(const TouchSurface& box, int axis, double one, double other) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const std::array<Vector3d, 2> beyond = {one * Vector3d::Unit(u), other * Vector3d::Unit(v)};
  return {box.half[u] * beyond[0] + box.half[v] * beyond[1], Vector3d::Unit(axis), box.half[axis],
          beyond};
}

void set_points(const MovingPoint& first, const MovingPoint& second, double radius,
                TouchPlace& out) {
  const Vector3d d = second.x - first.x, d_rate = second.rate - first.rate;
  const double length = d.norm();
  out.normal = length > 0.0 ? Vector3d(d / length) : Vector3d::UnitZ();
  out.normal_rate = Vector3d::Zero();
  if (length > 0.0) out.normal_rate = (d_rate - out.normal.dot(d_rate) * out.normal) / length;
  out.gap = length - radius;
  out.place = 0.5 * (first.x + second.x + radius * out.normal);
  out.place_rate = 0.5 * (first.rate + second.rate + radius * out.normal_rate);
}

void leave_to_rim(double beyond, const Vector3d& axis, double radius, TouchPlace& out) {
  if (beyond <= kPastEnd * radius && std::abs(axis.dot(out.normal)) < kAcross) return;
  out.gap = std::abs(out.gap) + kPastEnd * radius;
  turn_round(out);
}

void set_apart(const MarkerMotion& F, const MarkerMotion& M, TouchPlace& out) {
  set_points({F.p, F.v}, {M.p, M.v}, 0.0, out);
}

namespace {

/// @param place what finds the place on one side, and its answer
/// @return that of the place taken
template <class Place>
bool set_side(double towards, double radius, Place place, TouchPlace& out) {
  const bool answer = place(towards, out);
  TouchPlace other;
  const bool other_answer = place(-towards, other);
  if (!(other.gap < out.gap - kSidesApart * radius)) return answer;
  out = other;
  return other_answer;
}

}  // namespace

bool set_rim_over_edge(const SharpEdge& edge, const MarkerMotion& F, const Rim& rim,
                       const MarkerMotion& M, double towards, TouchPlace& out) {
  LinePoint line{F, F.p + F.R * edge.middle, F.R * edge.along, 0.0};
  RimPoint point(rim, M);
  if (set_far_rim(line, edge.half_length, 0.0, point, out)) return false;
  const auto place = [&](double side, TouchPlace& found) {
    point.turn_to(
        towards_line(point.axis, rim.radius, line.middle - point.centre, line.along, side));
    line.at = line.along.dot(point.place() - line.middle);
    const bool is_free = std::abs(line.at) <= (1.0 + kOnBorder) * edge.half_length;
    if (!is_free) {
      line.at = std::copysign(edge.half_length, line.at);
      point.turn_to(point.nearest_to(line.x()));
    }
    const NearPoints points(line, point, is_free);
    const Across across = is_free ? set_across(edge, line, point, points, found) : Across::not_set;
    if (across == Across::not_set) set_points(points.on_line, points.on_rim, 0.0, found);
    return across == Across::out_of_both;
  };
  return set_side(towards, rim.radius, place, out);
}

void set_rim_over_side(const TouchSurface& cylinder, const MarkerMotion& F, const Rim& rim,
                       const MarkerMotion& M, double towards, TouchPlace& out) {
  LinePoint line{F, F.p, F.R * cylinder.axis, 0.0};
  RimPoint point(rim, M);
  if (set_far_rim(line, cylinder.half_length, cylinder.radius, point, out)) return;
  const auto place = [&](double side, TouchPlace& found) {
    point.turn_to(
        towards_line(point.axis, rim.radius, line.middle - point.centre, line.along, side));
    line.at = line.along.dot(point.place() - line.middle);
    const NearPoints points(line, point, true);
    if (std::abs(line.at) <= (1.0 + kOnBorder) * cylinder.half_length) {
      set_points(points.on_line, points.on_rim, cylinder.radius, found);
    } else {
      set_sphere_at(cylinder, F, points.on_rim, 0.0, found);
    }
    return true;
  };
  set_side(towards, rim.radius, place, out);
}

MovingPoint lowest_of_rim(const Rim& rim, const MarkerMotion& M, const Vector3d& normal,
                          const Vector3d& normal_rate) {
  RimPoint point(rim, M);
  // Downhill within the end.
  const double along = point.axis.dot(normal);
  Vector3d down = along * point.axis - normal, down_rate;
  const double tilt = down.norm();
  if (tilt > kLevelRim) {
    const Vector3d axis_rate = M.w.cross(point.axis);
    const double along_rate = axis_rate.dot(normal) + point.axis.dot(normal_rate);
    down_rate = (along_rate * point.axis + along * axis_rate - normal_rate) / tilt;
    down /= tilt;
    down_rate -= down.dot(down_rate) * down;
  } else {
    down = M.R * rim.axis.unitOrthogonal();
    down_rate = M.w.cross(down);
  }
  point.turn_to(down);
  return {point.place(), point.centre_rate() + rim.radius * down_rate};
}

void set_rim_over_face(const TouchSurface& solid, int axis, const MarkerMotion& F, const Rim& rim,
                       const MarkerMotion& M, TouchPlace& out) {
  const Vector3d up = solid.kind == TouchSurface::Kind::box ? Vector3d::Unit(axis) : solid.axis;
  Vector3d normal = F.R * up;
  if (normal.dot(M.p + M.R * rim.middle - F.p) < 0.0) normal = -normal;
  const Vector3d normal_rate = F.w.cross(normal);
  const MovingPoint lowest = lowest_of_rim(rim, M, normal, normal_rate);
  const Vector3d x = F.R.transpose() * (lowest.x - F.p);
  const OverFace over(solid, axis, F.R.transpose() * normal, x);
  if (!over.is_over) {
    return set_sphere_at(solid, F, lowest, 0.0, out);
  }
  out.normal = normal;
  out.normal_rate = normal_rate;
  out.gap = over.height;
  out.place = lowest.x;
  out.place_rate = lowest.rate;
}

}  // namespace buckens::spatial
