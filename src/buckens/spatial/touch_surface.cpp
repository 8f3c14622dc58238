// SPDX-License-Identifier: Apache-2.0
#include "buckens/spatial/touch_surface.h"

#include <algorithm>
#include <cmath>

namespace buckens::spatial {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Around a point or an axis.
/// @param out from there to the point, @param across projector onto the directions that `out` has
/// @param sign −1: seen from inside
TouchSurface::View TouchSurface::from_centre(const Vector3d& out, const Matrix3d& across,
                                             double sign) const {
  const double length = out.norm();
  View view;
  view.distance = sign * (length - radius);
  if (length > 0.0) {
    view.normal = sign / length * out;
    view.curvature = sign / length * (across - view.normal * view.normal.transpose());
  } else {
    view.normal = axis.unitOrthogonal();
  }
  return view;
}

TouchSurface::View TouchSurface::from_cylinder(const Vector3d& point) const {
  const Matrix3d across = Matrix3d::Identity() - axis * axis.transpose();
  const double along = axis.dot(point);
  const View beside = from_centre(point - along * axis, across, 1.0);
  View beyond;
  beyond.normal = along < 0.0 ? Vector3d(-axis) : axis;
  beyond.distance = std::abs(along) - half_length;
  if (beside.distance <= 0.0 || beyond.distance <= 0.0) {
    return beside.distance > beyond.distance ? beside : beyond;
  }
  View rim;
  rim.distance = std::hypot(beside.distance, beyond.distance);
  rim.normal = (beside.distance * beside.normal + beyond.distance * beyond.normal) / rim.distance;
  // Around the circle, and along it.
  const Vector3d turned =
      (beside.distance * beyond.normal - beyond.distance * beside.normal) / rim.distance;
  rim.curvature = turned * turned.transpose() / rim.distance +
                  beside.distance / rim.distance * beside.curvature;
  return rim;
}

TouchSurface::View TouchSurface::from_box(const Vector3d& point) const {
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
  const Vector3d free = (beyond.array() > 0.0).cast<double>();
  view.curvature =
      (Matrix3d(free.asDiagonal()) - view.normal * view.normal.transpose()) / view.distance;
  return view;
}

TouchSurface::View TouchSurface::look(const Vector3d& point) const {
  const Matrix3d all = Matrix3d::Identity();
  const double along = axis.dot(point);
  switch (kind) {
    case Kind::plane:
      return {along, axis, Matrix3d::Zero()};
    case Kind::sphere:
      return from_centre(point, all, 1.0);
    case Kind::socket:
      return from_centre(point, all, -1.0);
    case Kind::bore:
      return from_centre(point - along * axis, all - axis * axis.transpose(), -1.0);
    case Kind::capsule: {
      const double nearest = std::clamp(along, -half_length, half_length);
      const bool is_beside = nearest == along;
      return from_centre(point - nearest * axis,
                         is_beside ? Matrix3d(all - axis * axis.transpose()) : all, 1.0);
    }
    case Kind::cylinder:
      return from_cylinder(point);
    case Kind::box:
      return from_box(point);
  }
  return {};
}

}  // namespace buckens::spatial
