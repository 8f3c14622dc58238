// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>

#include <Eigen/Core>

#include "buckens/base/field.h"
#include "buckens/base/source_location.h"
#include "buckens/spatial/triangle_list.h"

namespace buckens::loads {

// Shapes that bodies touch each other with. All of them are placed by a marker: its origin is their
// centre (of a plane: a point on it), its axes are those that directions and sizes refer to.

struct PlaneShape {
  static constexpr const char* kKey = "plane";
  static constexpr const char* kDoc =
      "unbounded plane through the marker; the other body is on the side of the normal";
  std::optional<Eigen::Vector3d> normal;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("normal", normal, "direction out of the solid, in the marker's axes")
              .shorthand()
              .like("[0, 0, 1]")
              .otherwise("z of the marker; needed in planar models"));
  }
};

template <class Visitor>
void visit_radius(Visitor& visit, double& radius) {
  visit(base::field("radius", radius, "radius")
            .in(base::kLength)
            .required()
            .positive()
            .shorthand()
            .like("50 mm"));
}

template <class Visitor>
void visit_axis(Visitor& visit, std::optional<Eigen::Vector3d>& axis) {
  visit(base::field("axis", axis, "its axis, in the marker's axes")
            .like("[0, 0, 1]")
            .otherwise("z of the marker"));
}

struct SphereShape {
  static constexpr const char* kKey = "sphere";
  static constexpr const char* kDoc = "sphere about the marker; in planar models a circle";
  double radius = 0;  ///< [m]

  template <class Visitor>
  void fields(Visitor& visit) {
    visit_radius(visit, radius);
  }
};

struct SocketShape {
  static constexpr const char* kKey = "socket";
  static constexpr const char* kDoc =
      "hollow sphere about the marker; the other body is inside; in planar models a hole";
  double radius = 0;  ///< [m]

  template <class Visitor>
  void fields(Visitor& visit) {
    visit_radius(visit, radius);
  }
};

struct BoreShape {
  static constexpr const char* kKey = "bore";
  static constexpr const char* kDoc =
      "hole of a bearing along an axis through the marker, as long as the pin in it";
  double radius = 0;  ///< [m]
  std::optional<Eigen::Vector3d> axis;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit_radius(visit, radius);
    visit_axis(visit, axis);
  }
};

/// Common to capsule and cylinder.
struct LongShape {
  double radius = 0;  ///< [m]
  double length = 0;  ///< [m]
  std::optional<Eigen::Vector3d> axis;

  template <class Visitor>
  void long_fields(Visitor& visit, const char* doc_of_length) {
    visit(base::field("radius", radius, "radius")
              .in(base::kLength)
              .required()
              .positive()
              .like("20 mm"));
    visit(base::field("length", length, doc_of_length)
              .in(base::kLength)
              .required()
              .positive()
              .like("100 mm"));
    visit_axis(visit, axis);
  }
};

struct CapsuleShape : LongShape {
  static constexpr const char* kKey = "capsule";
  static constexpr const char* kDoc = "cylinder with round ends, its middle at the marker";
  template <class Visitor>
  void fields(Visitor& visit) {
    long_fields(visit, "distance between the centres of its round ends");
  }
};

struct CylinderShape : LongShape {
  static constexpr const char* kKey = "cylinder";
  static constexpr const char* kDoc = "cylinder with flat ends, its middle at the marker";
  template <class Visitor>
  void fields(Visitor& visit) {
    long_fields(visit, "distance between its ends");
  }
};

struct BoxShape {
  static constexpr const char* kKey = "box";
  static constexpr const char* kDoc = "box along the marker's axes, its middle at the marker";
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< whole edges [m]

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("size", size, "lengths of its edges along x, y and z")
              .in(base::kLength)
              .required()
              .positive()
              .shorthand()
              .like("[100 mm, 50 mm, 20 mm]"));
  }
};

template <class Visitor>
void visit_smooth(Visitor& visit, double& smooth) {
  visit(base::field("smooth", smooth,
                    "triangles that are inclined against their neighbours by no more than this "
                    "are one curved surface, others meet in sharp edges")
            .in(base::kAngle)
            .positive()
            .like("30 deg"));
}

template <class Visitor>
void visit_spacing(Visitor& visit, std::optional<double>& spacing) {
  visit(base::field("spacing", spacing,
                    "greatest distance of the springs that stand for the surface where it touches "
                    "another one of triangles")
            .in(base::kLength)
            .positive()
            .like("5 mm")
            .otherwise("a fifth of the side of a square that has a sixth of its area"));
}

/// As CAD programs write cylinders, with about twenty sides.
inline constexpr double kSmoothAngle = 0.523598775598298873;  // 30°

struct StlShape {
  static constexpr const char* kKey = "stl";
  static constexpr const char* kDoc =
      "surface of triangles from an STL file, text or binary, placed by the marker; it can touch "
      "planes, spheres, capsules, cylinders, boxes and other surfaces of triangles, with a "
      "stiffness capsules only with their ends, cylinders with their rims, boxes with their "
      "corners";
  SourceLocation where;
  std::string file;
  double unit = 0;  ///< [m]
  double smooth = kSmoothAngle;
  std::optional<double> spacing;  ///< [m]
  /// Set by the reader of model files; programs may set it in place of `file`.
  std::shared_ptr<const spatial::TriangleList> triangles;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("file", file, "name of the file, relative to the model file")
              .required()
              .like("bowl.stl"));
    visit(base::field("unit", unit, "length of one unit of the file, which does not state it")
              .in(base::kLength)
              .required()
              .positive()
              .like("1 mm"));
    visit_smooth(visit, smooth);
    visit_spacing(visit, spacing);
  }
};

struct SurfaceShape {
  static constexpr const char* kKey = "surface";
  static constexpr const char* kDoc =
      "outer surface of the mesh of the marker's body (solids and shells), in its undeformed "
      "shape; it moves with the marker and touches what `stl` touches";
  double smooth = kSmoothAngle;
  std::optional<double> spacing;  ///< [m]

  template <class Visitor>
  void fields(Visitor& visit) {
    visit_smooth(visit, smooth);
    visit_spacing(visit, spacing);
  }
};

/// One of the shapes.
struct ShapeSpec {
  std::variant<PlaneShape, SphereShape, SocketShape, BoreShape, CapsuleShape, CylinderShape,
               BoxShape, StlShape, SurfaceShape>
      kind;

  /// Key of the shape in the model file.
  const char* kind_name() const {
    return std::visit([]<class T>(const T&) { return T::kKey; }, kind);
  }

  /// Kind of shape used for contact: see ContactShape::Kind.
  const char* touches_as() const {
    const bool is_mesh =
        std::holds_alternative<StlShape>(kind) || std::holds_alternative<SurfaceShape>(kind);
    return is_mesh ? "mesh" : kind_name();
  }

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::inlined(kind, "shape").required());
  }
};

}  // namespace buckens::loads
