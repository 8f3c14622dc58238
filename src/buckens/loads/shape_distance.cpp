// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/shape_distance.h"

#include <algorithm>
#include <cmath>

#include "buckens/loads/contact_mesh.h"

namespace buckens::loads {

using Eigen::Vector3d;
using ShapeKind = ContactShape::Kind;

namespace {

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

}  // namespace

double distance_from(const ContactShape& shape, const Vector3d& point, Vector3d& normal) {
  const Vector3d& axis = shape.axis;
  switch (shape.kind) {
    case ShapeKind::plane:
      normal = axis;
      return axis.dot(point);
    case ShapeKind::sphere:
      return length_of(point, axis, normal) - shape.radius;
    case ShapeKind::socket:
    case ShapeKind::bore: {
      const bool is_bore = shape.kind == ShapeKind::bore;
      const double out =
          length_of(is_bore ? Vector3d(point - axis * axis.dot(point)) : point, axis, normal);
      normal = -normal;
      return shape.radius - out;
    }
    case ShapeKind::capsule: {
      const double along = std::clamp(axis.dot(point), -shape.half_length, shape.half_length);
      return length_of(point - along * axis, axis, normal) - shape.radius;
    }
    case ShapeKind::cylinder:
      return from_cylinder(shape, point, normal);
    case ShapeKind::box:
      return from_box(shape, point, normal);
    case ShapeKind::mesh: {
      const ContactMesh::Nearest place = shape.mesh->nearest(point);
      normal = place.normal;
      return place.distance;
    }
  }
  return HUGE_VAL;
}

}  // namespace buckens::loads
