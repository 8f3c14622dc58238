// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/rigid_touches.h"

#include <cmath>
#include <utility>

#include "buckens/loads/cylinder_over_mesh.h"
#include "buckens/loads/mesh_touch.h"
#include "buckens/loads/polyhedron_touch.h"
#include "buckens/loads/shape_distance.h"
#include "buckens/spatial/capsule_touch.h"
#include "buckens/spatial/cylinder_touch.h"

namespace buckens::model {

using Eigen::Vector3d;
using loads::ContactShape;
using spatial::RigidTouch;
using ShapeKind = ContactShape::Kind;
using Feature = RigidTouch::Feature;

namespace {

// Share of the radius at which points lie that stay on an end.
constexpr double kInsideRim = 0.9999;

std::vector<Vector3d> ends_of(const ContactShape& shape) {
  return {shape.half_length * shape.axis, -shape.half_length * shape.axis};
}

std::vector<Vector3d> centres_of(const ContactShape& shape) {
  if (shape.kind == ShapeKind::sphere) return {Vector3d::Zero()};
  return ends_of(shape);
}

std::vector<Vector3d> corners_of(const ContactShape& shape) {
  std::vector<Vector3d> out = {Vector3d::Zero()};
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == shape.flat) continue;
    const Vector3d half = shape.half[axis] * Vector3d::Unit(axis);
    for (std::size_t k = out.size(); k-- > 0;) {
      out.push_back(out[k] - half);
      out[k] += half;
    }
  }
  return out;
}

class TouchList {
 public:
  TouchList(const loads::ContactPair& pair, const joints::Placement& placed,
            const std::optional<Vector3d>& normal)
      : first_(pair.first()), second_(pair.second()) {
    M_.p = placed.r_F;
    M_.R = placed.R_WF.transpose() * placed.R_WM;
    if (normal) out_of_plane_ = placed.R_WF.transpose() * *normal;
  }

  std::vector<RigidTouch> find() {
    if (first_.kind == ShapeKind::capsule && second_.kind == ShapeKind::capsule) {
      add_capsules();
    } else if (first_.kind == ShapeKind::box && second_.kind == ShapeKind::box && out_of_plane_) {
      add_found(loads::flat_box_touches(first_, second_));
    } else if (second_.kind == ShapeKind::capsule && first_.kind == ShapeKind::box) {
      add_capsule_on_box();
    } else if (second_.kind == ShapeKind::capsule && first_.kind == ShapeKind::cylinder) {
      add_capsule_on_cylinder();
    } else if (second_.kind == ShapeKind::cylinder && first_.kind == ShapeKind::plane) {
      add_rim(1.0);
      add_rim(-1.0);
    } else if ((first_.kind == ShapeKind::mesh || first_.kind == ShapeKind::box) &&
               (second_.kind == ShapeKind::mesh || second_.kind == ShapeKind::box)) {
      add_found(
          loads::polyhedron_touches(loads::polyhedron_of(first_), loads::polyhedron_of(second_)));
    } else if (second_.kind == ShapeKind::cylinder && first_.kind == ShapeKind::box) {
      add_found(
          spatial::cylinder_over_box(loads::touch_surface(first_), loads::touch_surface(second_)));
    } else if (second_.kind == ShapeKind::cylinder && first_.kind == ShapeKind::cylinder) {
      add_found(spatial::cylinder_over_cylinder(loads::touch_surface(first_),
                                                loads::touch_surface(second_)));
    } else if (second_.kind == ShapeKind::mesh) {
      add_found(loads::plane_touches(loads::touch_surface(first_), *second_.mesh));
    } else if (first_.kind == ShapeKind::mesh) {
      add_on_mesh();
    } else {
      add_points(Feature::point_of_second, first_, second_);
    }
    return std::move(touches_);
  }

 private:
  /// @param surface that the spheres, ends or corners of the other shape touch
  void add_points(Feature feature, const ContactShape& surface, const ContactShape& points) {
    RigidTouch::Data data;
    data.feature = feature;
    data.surface = loads::touch_surface(surface);
    const bool has_corners = points.kind == ShapeKind::box;
    data.radius = has_corners ? 0.0 : points.radius;
    if (has_corners) return add(data, corners_of(points));
    add(data, centres_of(points));
  }

  /// Ends at the other one's side hold capsules that lie side by side; those that cross touch
  /// between their ends.
  void add_capsules() {
    add_points(Feature::point_of_second, first_, second_);
    add_points(Feature::point_of_first, second_, first_);
    if (out_of_plane_) return;
    RigidTouch::Data data;
    data.feature = Feature::axes;
    data.surface = loads::touch_surface(first_);
    data.radius = second_.radius;
    data.axis = second_.axis;
    data.half_length = second_.half_length;
    add(data, {Vector3d::Zero()});
  }

  void add_capsule_on_box() {
    add_points(Feature::point_of_second, first_, second_);
    const spatial::TouchSurface box = loads::touch_surface(first_);
    const spatial::TouchSurface capsule = loads::touch_surface(second_);
    add_found(spatial::capsule_over_edges(box, capsule));
  }

  void add_capsule_on_cylinder() {
    add_points(Feature::point_of_second, first_, second_);
    const spatial::TouchSurface cylinder = loads::touch_surface(first_);
    const spatial::TouchSurface capsule = loads::touch_surface(second_);
    add_found({spatial::capsule_across_cylinder(cylinder, capsule)});
    for (const double end : {1.0, -1.0}) {
      for (const double towards : {1.0, -1.0}) {
        add_found({spatial::capsule_over_rim(cylinder, capsule, end, towards)});
      }
    }
  }

  /// A sphere, a capsule or a cylinder.
  void add_on_mesh() {
    const spatial::TouchSurface over = loads::touch_surface(second_);
    if (second_.kind == ShapeKind::sphere) {
      add_found(loads::sphere_touches(first_.mesh, second_.radius, Vector3d::Zero()));
    } else if (second_.kind == ShapeKind::capsule) {
      add_found(loads::capsule_touches(first_.mesh, over));
    } else {
      add_found(loads::cylinder_over_mesh(loads::polyhedron_of(first_), over));
    }
  }

  void add_found(const spatial::TouchFinders& finders) {
    RigidTouch::Data data;
    data.feature = Feature::found;
    for (const auto& finder : finders) {
      data.finder = finder;
      add(data, {Vector3d::Zero()});
    }
  }

  /// The lowest point of an end, and four that stay where they are on it, so that it can stand.
  void add_rim(double end) {
    RigidTouch::Data data;
    data.feature = Feature::rim;
    data.surface = loads::touch_surface(first_);
    data.radius = second_.radius;
    data.axis = second_.axis;
    const Vector3d middle = end * second_.half_length * second_.axis;
    add(data, {middle});
    // Between the lowest point as placed and its opposite, and hardly inside the rim: what rolls
    // does not touch with them.
    const Vector3d rim = M_.R.transpose() * (touches_.back().look(F_, M_).place - M_.p) - middle;
    const Vector3d lowest = kInsideRim * rim;
    const Vector3d across = second_.axis.cross(lowest);
    RigidTouch::Data fixed;
    fixed.surface = data.surface;
    add(fixed, {middle + M_SQRT1_2 * (lowest + across), middle + M_SQRT1_2 * (lowest - across),
                middle - M_SQRT1_2 * (lowest + across), middle - M_SQRT1_2 * (lowest - across)});
  }

  void add(RigidTouch::Data data, const std::vector<Vector3d>& places) {
    data.out_of_plane = out_of_plane_;
    for (const Vector3d& at : places) {
      data.at = at;
      data.pole = RigidTouch(data).look(F_, M_).normal;
      touches_.emplace_back(data);
    }
  }

  const ContactShape &first_, &second_;
  spatial::MarkerMotion F_, M_;  // as placed, in axes of the first marker
  std::optional<Vector3d> out_of_plane_;
  std::vector<RigidTouch> touches_;
};

}  // namespace

std::vector<RigidTouch> rigid_touches(const loads::ContactPair& pair,
                                      const joints::Placement& placed,
                                      const std::optional<Vector3d>& normal) {
  return TouchList(pair, placed, normal).find();
}

}  // namespace buckens::model
