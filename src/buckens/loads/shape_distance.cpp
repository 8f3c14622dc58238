// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/shape_distance.h"

#include "buckens/loads/contact_mesh.h"

namespace buckens::loads {

using spatial::TouchSurface;
using ShapeKind = ContactShape::Kind;

TouchSurface touch_surface(const ContactShape& shape) {
  TouchSurface out;
  switch (shape.kind) {
    case ShapeKind::plane:
    case ShapeKind::mesh:  // has none
      out.kind = TouchSurface::Kind::plane;
      break;
    case ShapeKind::sphere:
      out.kind = TouchSurface::Kind::sphere;
      break;
    case ShapeKind::socket:
      out.kind = TouchSurface::Kind::socket;
      break;
    case ShapeKind::bore:
      out.kind = TouchSurface::Kind::bore;
      break;
    case ShapeKind::capsule:
      out.kind = TouchSurface::Kind::capsule;
      break;
    case ShapeKind::cylinder:
      out.kind = TouchSurface::Kind::cylinder;
      break;
    case ShapeKind::box:
      out.kind = TouchSurface::Kind::box;
      break;
  }
  out.axis = shape.axis;
  out.radius = shape.radius;
  out.half_length = shape.half_length;
  out.half = shape.half;
  out.flat = shape.flat;
  return out;
}

double distance_from(const ContactShape& shape, const Eigen::Vector3d& point,
                     Eigen::Vector3d& normal) {
  if (shape.kind == ShapeKind::mesh) {
    const ContactMesh::Nearest place = shape.mesh->nearest(point);
    normal = place.normal;
    return place.distance;
  }
  const TouchSurface::View view = touch_surface(shape).look(point, false);
  normal = view.normal;
  return view.distance;
}

}  // namespace buckens::loads
