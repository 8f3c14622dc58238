// SPDX-License-Identifier: Apache-2.0
#include "buckens/spatial/touch_features.h"

#include "buckens/spatial/segment_pair.h"

namespace buckens::spatial {

using Eigen::Vector3d;

namespace {

/// @param on_second the place is that of the sphere
void set_by_view(const TouchSurface::View& view, const MarkerMotion& other,
                 const MovingPoint& point, double radius, bool on_second, TouchPlace& out) {
  const Vector3d from = point.x - other.p;
  const Vector3d own_rate = other.R.transpose() * (point.rate - other.v - other.w.cross(from));
  out.normal = other.R * view.normal;
  out.normal_rate = other.w.cross(out.normal) + other.R * (view.curvature * own_rate);
  out.gap = view.distance - radius;
  const double down = on_second ? radius : 0.5 * (view.distance + radius);
  const double down_rate = on_second ? 0.0 : 0.5 * view.normal.dot(own_rate);
  out.place = point.x - down * out.normal;
  out.place_rate = point.rate - down * out.normal_rate - down_rate * out.normal;
}

}  // namespace

void set_sphere_at(const TouchSurface& surface, const MarkerMotion& other, const MovingPoint& point,
                   double radius, TouchPlace& out) {
  const TouchSurface::View view = surface.look(other.R.transpose() * (point.x - other.p));
  set_by_view(view, other, point, radius, surface.kind == TouchSurface::Kind::plane, out);
}

void set_sphere_at(const TouchSurface::View& view, const MarkerMotion& other,
                   const MovingPoint& point, double radius, TouchPlace& out) {
  set_by_view(view, other, point, radius, false, out);
}

void set_segments(const RoundSegment& first, const MarkerMotion& F, const RoundSegment& second,
                  const MarkerMotion& M, const Vector3d& otherwise, TouchPlace& out) {
  const MovingPoint middle = MovingPoint::of(F, first.middle);
  const MovingPoint other_middle = MovingPoint::of(M, second.middle);
  const Vector3d r = other_middle.x - middle.x, r_rate = other_middle.rate - middle.rate;
  const Vector3d a = F.R * first.half, b = M.R * second.half;
  const Vector3d a_rate = F.w.cross(a), b_rate = M.w.cross(b);
  const auto nearest = NearestOfSegments::of(r, a, b);
  const Eigen::Vector2d rates = nearest.rates(r, a, b, r_rate, a_rate, b_rate);
  const Vector3d on_first = middle.x + nearest.on_first * a;
  const Vector3d first_rate = middle.rate + rates[0] * a + nearest.on_first * a_rate;
  const Vector3d between = r + nearest.on_second * b - nearest.on_first * a;
  const Vector3d between_rate =
      r_rate + rates[1] * b + nearest.on_second * b_rate - rates[0] * a - nearest.on_first * a_rate;
  const double length = between.norm();
  if (length > 0.0) {
    out.normal = between / length;
    out.normal_rate = (between_rate - out.normal.dot(between_rate) * out.normal) / length;
  } else {
    out.normal = otherwise;
    out.normal_rate = Vector3d::Zero();
  }
  out.gap = length - first.radius - second.radius;
  const double beyond = 0.5 * (first.radius - second.radius);
  out.place = on_first + 0.5 * between + beyond * out.normal;
  out.place_rate = first_rate + 0.5 * between_rate + beyond * out.normal_rate;
}

void set_crossing(const MovingEdge& first, const MovingEdge& second, const Vector3d& along,
                  TouchPlace& out) {
  const Vector3d r = second.middle - first.middle, r_rate = second.rate() - first.rate();
  const auto nearest = NearestOfSegments::of_lines(r, first.half, second.half);
  const Eigen::Vector2d rates =
      nearest.rates(r, first.half, second.half, r_rate, first.half_rate(), second.half_rate());
  Vector3d across = first.half.cross(second.half);
  Vector3d across_rate =
      first.half_rate().cross(second.half) + first.half.cross(second.half_rate());
  if (across.dot(along) < 0.0) {
    across = -across;
    across_rate = -across_rate;
  }
  const double size = across.norm();
  out.normal = across / size;
  out.normal_rate = (across_rate - out.normal.dot(across_rate) * out.normal) / size;
  out.gap = out.normal.dot(r);
  const auto place_on = [](const MovingEdge& edge, double at) -> Vector3d {
    return edge.middle + at * edge.half;
  };
  const auto rate_on = [](const MovingEdge& edge, double at, double rate) -> Vector3d {
    return edge.rate() + at * edge.half_rate() + rate * edge.half;
  };
  out.place = 0.5 * (place_on(first, nearest.on_first) + place_on(second, nearest.on_second));
  out.place_rate = 0.5 * (rate_on(first, nearest.on_first, rates[0]) +
                          rate_on(second, nearest.on_second, rates[1]));
}

}  // namespace buckens::spatial
