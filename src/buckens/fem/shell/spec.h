// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "buckens/base/field.h"
#include "buckens/fem/element/material_spec.h"

namespace buckens::fem {

/// One layer of a shell in a model file.
struct ShellLayerSpec {
  SourceLocation where;
  std::optional<base::Reference<MaterialSpec>> material;
  double thickness = 0;  ///< [m]
  double angle = 0;      ///< [rad]

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("thickness", thickness, "thickness of the layer")
              .in(base::kLength)
              .required()
              .positive()
              .like("0.25 mm"));
    visit(base::field("angle", angle,
                      "from the x axis of the shell to material direction 1, about the normal")
              .in(base::kAngle)
              .like("45 deg"));
    visit(base::field("material", material, "material: a name from `materials` or written in place")
              .like("cfrp")
              .otherwise("that of the shell"));
  }
};

/// Common to all shells. Exactly one of thickness and layers is given.
struct ShellPropertySpec {
  std::optional<double> thickness;  ///< [m]
  std::vector<ShellLayerSpec> layers;
  double offset = 0;                         ///< [m]
  std::optional<Eigen::Vector3d> direction;  ///< model axes

  template <class Visitor>
  void shell_fields(Visitor& visit) {
    visit(base::field("thickness", thickness, "thickness of a shell of one material")
              .in(base::kLength)
              .positive()
              .like("5 mm")
              .otherwise("give this or `layers`"));
    visit(base::field("layers", layers,
                      "layers of a laminate from the negative to the positive side of the normal")
              .like("[{thickness: 0.25 mm, angle: 45 deg}, {thickness: 0.25 mm, angle: -45 deg}]")
              .otherwise("give this or `thickness`"));
    visit(base::field("offset", offset,
                      "distance of the middle surface from the nodes, along the normal")
              .in(base::kLength)
              .like("2.5 mm"));
    visit(base::field("direction", direction,
                      "the x axis of the shell is this direction projected onto it; angles of "
                      "layers are measured from it")
              .like("[1, 0, 0]")
              .otherwise("model x; model z where that is normal to the shell"));
  }
};

/// One shell element between named nodes.
struct ShellMemberSpec : ShellPropertySpec {
  SourceLocation where;
  std::vector<std::string> nodes;
  base::Reference<MaterialSpec> material;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field(
              "nodes", nodes,
              "three or four corners, counter-clockwise seen from the side the normal points to, "
              "followed by the nodes on all sides, if any, starting between the first two corners")
              .required()
              .like("[a, b, c, d]"));
    visit(base::field("material", material, "material: a name from `materials` or written in place")
              .required()
              .like("steel"));
    shell_fields(visit);
  }
};

/// Shells of a generated mesh.
enum class ShellShapeKind { quad4, tri3, quad8, tri6 };

constexpr std::array<const char*, 4> choice_names(ShellShapeKind) {
  return {"quad4", "tri3", "quad8", "tri6"};
}
constexpr bool is_quadratic(ShellShapeKind kind) {
  return kind == ShellShapeKind::quad8 || kind == ShellShapeKind::tri6;
}

/// A rectangular plate in the x–y plane, divided regularly.
struct PlateMeshSpec : ShellPropertySpec {
  static constexpr const char* kKey = "plate";
  static constexpr const char* kDoc =
      "rectangular plate of shells, parallel to the model's x–y plane, its normal along z; the "
      "node "
      "sets x0, x1, y0, y1 are its edges, the faces `top` and `bottom` its sides";
  SourceLocation where;
  Eigen::Vector3d from = Eigen::Vector3d::Zero();  ///< corner with the smallest coordinates [m]
  std::array<double, 2> size = {1, 1};             ///< [m]
  std::array<int, 2> divisions = {1, 1};
  ShellShapeKind element = ShellShapeKind::quad4;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("from", from, "corner with the smallest coordinates, in model axes")
              .in(base::kLength)
              .like("[0, -1 m, 0]"));
    visit(base::field("size", size, "edge lengths along x, y")
              .in(base::kLength)
              .required()
              .positive()
              .like("[10 m, 10 m]"));
    visit(base::field("divisions", divisions, "number of fields along x, y")
              .required()
              .positive()
              .like("[16, 16]"));
    visit(base::field("element", element,
                      "shell element: one `quad4` or two triangles `tri3` per field; `quad8` and "
                      "`tri6` also have nodes on their sides"));
    shell_fields(visit);
  }
};

}  // namespace buckens::fem
