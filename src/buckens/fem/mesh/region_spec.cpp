// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/mesh/region_spec.h"

#include <algorithm>
#include <cmath>

namespace buckens::fem {

using Eigen::Vector3d;

double distance(const SphereSelection& sphere, const Vector3d& point) {
  return std::max(0.0, (point - sphere.center).norm() - sphere.radius);
}

double distance(const BoxSelection& box, const Vector3d& point) {
  const Vector3d least = box.from.cwiseMin(box.to), most = box.from.cwiseMax(box.to);
  return (point - point.cwiseMax(least).cwiseMin(most)).norm();
}

double distance(const CylinderSelection& cylinder, const Vector3d& point) {
  const double length = (cylinder.to - cylinder.from).norm();
  const Vector3d axis = (cylinder.to - cylinder.from) / length;
  const double along = axis.dot(point - cylinder.from);
  const double across = (point - cylinder.from - along * axis).norm();
  const double beyond = std::max({0.0, -along, along - length});
  return std::hypot(beyond, std::max(0.0, across - cylinder.radius));
}

double distance(const PlaneSelection& plane, const Vector3d& point) {
  return std::abs(plane.normal.normalized().dot(point - plane.point));
}

}  // namespace buckens::fem
