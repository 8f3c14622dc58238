// SPDX-License-Identifier: Apache-2.0
#include "buckens/spatial/touch_surface.h"

#include <algorithm>
#include <cmath>

namespace buckens::spatial {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// @param out from the point, or from the axis at its place, @param sign −1: seen from inside
TouchSurface::View TouchSurface::from_centre(const Vector3d& out, Round round, double sign,
                                             bool with_curvature) const {
  const double length = out.norm();
  View view;
  view.distance = sign * (length - radius);
  if (!(length > 0.0)) {
    view.normal = axis.unitOrthogonal();
    return view;
  }
  view.normal = sign / length * out;
  if (!with_curvature) return view;
  view.curvature = Matrix3d::Identity() - view.normal * view.normal.transpose();
  if (round == Round::axis) view.curvature -= axis * axis.transpose();
  view.curvature *= sign / length;
  return view;
}

TouchSurface::View TouchSurface::from_cylinder(const Vector3d& point, bool with_curvature) const {
  const double along = axis.dot(point);
  const View beside = from_centre(point - along * axis, Round::axis, 1.0, with_curvature);
  View beyond;
  beyond.normal = along < 0.0 ? Vector3d(-axis) : axis;
  beyond.distance = std::abs(along) - half_length;
  if (beside.distance <= 0.0 || beyond.distance <= 0.0) {
    return beside.distance > beyond.distance ? beside : beyond;
  }
  return from_ring(beside, beyond, with_curvature);
}

/// @param beside of the axis, with the radius taken off, @param beyond the plane of the ring
TouchSurface::View TouchSurface::from_ring(const View& beside, const View& beyond,
                                           bool with_curvature) {
  View rim;
  rim.distance = std::hypot(beside.distance, beyond.distance);
  rim.normal = (beside.distance * beside.normal + beyond.distance * beyond.normal) / rim.distance;
  if (!with_curvature) return rim;
  // Around the circle, and along it.
  const Vector3d turned =
      (beside.distance * beyond.normal - beyond.distance * beside.normal) / rim.distance;
  rim.curvature = turned * turned.transpose() / rim.distance +
                  beside.distance / rim.distance * beside.curvature;
  return rim;
}

TouchSurface::View TouchSurface::from_box(const Vector3d& point, bool with_curvature) const {
  Vector3d beyond = point.cwiseAbs() - half;
  if (flat >= 0) beyond[flat] = -HUGE_VAL;
  const Vector3d side = point.unaryExpr([](double x) { return x < 0.0 ? -1.0 : 1.0; });
  View view;
  int most = 0;
  view.distance = beyond.maxCoeff(&most);
  if (view.distance <= 0.0) {
    view.normal = side[most] * Vector3d::Unit(most);
    return view;
  }
  const Vector3d out = beyond.cwiseMax(0.0).cwiseProduct(side);
  view.distance = out.norm();
  view.normal = out / view.distance;
  if (!with_curvature) return view;
  const Vector3d free = (beyond.array() > 0.0).cast<double>();
  view.curvature =
      (Matrix3d(free.asDiagonal()) - view.normal * view.normal.transpose()) / view.distance;
  return view;
}

TouchSurface::View TouchSurface::look(const Vector3d& point, bool with_curvature) const {
  const double along = axis.dot(point);
  switch (kind) {
    case Kind::plane:
      return {along, axis, Matrix3d::Zero()};
    case Kind::sphere:
      return from_centre(point, Round::point, 1.0, with_curvature);
    case Kind::socket:
      return from_centre(point, Round::point, -1.0, with_curvature);
    case Kind::bore:
      return from_centre(point - along * axis, Round::axis, -1.0, with_curvature);
    case Kind::capsule: {
      const double nearest = std::clamp(along, -half_length, half_length);
      const Round round = nearest == along ? Round::axis : Round::point;
      return from_centre(point - nearest * axis, round, 1.0, with_curvature);
    }
    case Kind::cylinder:
      return from_cylinder(point, with_curvature);
    case Kind::box:
      return from_box(point, with_curvature);
    case Kind::ring:
      return from_ring(from_centre(point - along * axis, Round::axis, 1.0, with_curvature),
                       {along - half_length, axis, Matrix3d::Zero()}, with_curvature);
  }
  return {};
}

}  // namespace buckens::spatial
