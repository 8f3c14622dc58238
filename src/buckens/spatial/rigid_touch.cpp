// SPDX-License-Identifier: Apache-2.0
#include "buckens/spatial/rigid_touch.h"

#include "buckens/spatial/box_touch.h"
#include "buckens/spatial/segment_pair.h"

namespace buckens::spatial {

using Eigen::Vector3d;

namespace {

// Where the normal is opposite to the one as placed, by this much, its way there is not unique.
constexpr double kOpposite = 1e-12;
// Sine of the tilt below which the lowest point of a rim says nothing.
constexpr double kUprightRim = 1e-6;

}  // namespace

PairRow TouchPlace::row(const Vector3d& direction, const MarkerMotion& F,
                        const MarkerMotion& M) const {
  PairRow J;
  J.segment<3>(0) = -(place - F.p).cross(direction).transpose();
  J.segment<3>(3) = -direction.transpose();
  J.segment<3>(6) = (place - M.p).cross(direction).transpose();
  J.segment<3>(9) = direction.transpose();
  return J;
}

Vector3d TouchPlace::velocity(const MarkerMotion& F, const MarkerMotion& M) const {
  return M.v + M.w.cross(place - M.p) - F.v - F.w.cross(place - F.p);
}

void RigidTouch::look_at_surface(const MarkerMotion& other, const MarkerMotion& owner,
                                 TouchPlace& out) const {
  const Vector3d lever = owner.R * data_.at;
  const Vector3d x = owner.p + lever;
  const Vector3d x_rate = owner.v + owner.w.cross(lever);
  const Vector3d from = x - other.p;
  const TouchSurface::View view = data_.surface.look(other.R.transpose() * from);
  const Vector3d own_rate = other.R.transpose() * (x_rate - other.v - other.w.cross(from));
  out.normal = other.R * view.normal;
  out.normal_rate = other.w.cross(out.normal) + other.R * (view.curvature * own_rate);
  out.gap = view.distance - data_.radius;
  // On planes the place is that of the sphere, else halfway between both surfaces.
  const bool is_plane = data_.surface.kind == TouchSurface::Kind::plane;
  const double down = is_plane ? data_.radius : 0.5 * (view.distance + data_.radius);
  const double down_rate = is_plane ? 0.0 : 0.5 * view.normal.dot(own_rate);
  out.place = x - down * out.normal;
  out.place_rate = x_rate - down * out.normal_rate - down_rate * out.normal;
}

void RigidTouch::look_at_rim(const MarkerMotion& F, const MarkerMotion& M, TouchPlace& out) const {
  out.normal = F.R * data_.surface.axis;
  out.normal_rate = F.w.cross(out.normal);
  const Vector3d axis = M.R * data_.axis;
  const Vector3d axis_rate = M.w.cross(axis);
  // Downhill within the end.
  const double along = axis.dot(out.normal);
  Vector3d down = along * axis - out.normal;
  Vector3d down_rate;
  const double tilt = down.norm();
  if (tilt > kUprightRim) {
    const double along_rate = axis_rate.dot(out.normal) + axis.dot(out.normal_rate);
    down_rate = (along_rate * axis + along * axis_rate - out.normal_rate) / tilt;
    down /= tilt;
    down_rate -= down.dot(down_rate) * down;
  } else {
    down = M.R * data_.axis.unitOrthogonal();
    down_rate = M.w.cross(down);
  }
  const Vector3d lever = M.R * data_.at;
  out.place = M.p + lever + data_.radius * down;
  out.place_rate = M.v + M.w.cross(lever) + data_.radius * down_rate;
  out.gap = out.normal.dot(out.place - F.p);
}

void RigidTouch::look_at_axes(const MarkerMotion& F, const MarkerMotion& M, TouchPlace& out) const {
  const Vector3d r = M.p - F.p, r_rate = M.v - F.v;
  const Vector3d a = F.R * data_.surface.axis * data_.surface.half_length;
  const Vector3d b = M.R * data_.axis * data_.half_length;
  const Vector3d a_rate = F.w.cross(a), b_rate = M.w.cross(b);
  const auto nearest = NearestOfSegments::of(r, a, b);
  const Eigen::Vector2d rates = nearest.rates(r, a, b, r_rate, a_rate, b_rate);
  const Vector3d on_first = F.p + nearest.on_first * a;
  const Vector3d first_rate = F.v + rates[0] * a + nearest.on_first * a_rate;
  const Vector3d between = r + nearest.on_second * b - nearest.on_first * a;
  const Vector3d between_rate =
      r_rate + rates[1] * b + nearest.on_second * b_rate - rates[0] * a - nearest.on_first * a_rate;
  const double length = between.norm();
  if (length > 0.0) {
    out.normal = between / length;
    out.normal_rate = (between_rate - out.normal.dot(between_rate) * out.normal) / length;
  } else {
    out.normal = F.R * data_.pole;
    out.normal_rate = Vector3d::Zero();
  }
  out.gap = length - data_.surface.radius - data_.radius;
  const double beyond = 0.5 * (data_.surface.radius - data_.radius);
  out.place = on_first + 0.5 * between + beyond * out.normal;
  out.place_rate = first_rate + 0.5 * between_rate + beyond * out.normal_rate;
}

TouchPlace RigidTouch::look(const MarkerMotion& F, const MarkerMotion& M) const {
  TouchPlace out;
  switch (data_.feature) {
    case Feature::point_of_second:
      look_at_surface(F, M, out);
      break;
    case Feature::point_of_first:
      look_at_surface(M, F, out);
      out.normal = -out.normal;
      out.normal_rate = -out.normal_rate;
      break;
    case Feature::rim:
      look_at_rim(F, M, out);
      break;
    case Feature::axes:
      look_at_axes(F, M, out);
      break;
    case Feature::boxes:
      look_at_boxes(data_.surface, data_.second, data_.direction, F, M, out);
      break;
  }
  set_directions(F, out);
  return out;
}

void RigidTouch::set_directions(const MarkerMotion& F, TouchPlace& out) const {
  if (data_.out_of_plane) {
    const Vector3d across = F.R * *data_.out_of_plane;
    out.along = {across.cross(out.normal).normalized(), across};
    return;
  }
  const Vector3d pole = F.R * data_.pole;
  const Vector3d x = F.R * data_.pole.unitOrthogonal();
  out.along = {x, pole.cross(x)};
  const double open = 1.0 + pole.dot(out.normal);
  if (open < kOpposite) {
    out.along[1] = -out.along[1];
    return;
  }
  for (Vector3d& u : out.along) u -= (out.normal.dot(u) / open) * (pole + out.normal);
}

}  // namespace buckens::spatial
