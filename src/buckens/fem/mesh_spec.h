// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "buckens/fem/solid_element_spec.h"
#include "buckens/fem/structure_spec.h"

namespace buckens::fem {

/// A block with edges along the model axes, divided regularly.
struct BoxMeshSpec : SolidElementSpec {
  static constexpr const char* kKey = "box";
  static constexpr const char* kDoc = "block with edges along the model axes, divided regularly";
  SourceLocation where;
  Eigen::Vector3d from = Eigen::Vector3d::Zero();  ///< corner with the least coordinates [m]
  Eigen::Vector3d size = Eigen::Vector3d::Ones();  ///< edge lengths [m]
  std::array<int, 3> divisions = {1, 1, 1};        ///< elements along x, y, z

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("from", from, "corner with the least coordinates, in model axes")
              .in(base::kLength)
              .like("[0, -50 mm, -50 mm]"));
    visit(base::field("size", size, "edge lengths along x, y, z")
              .in(base::kLength)
              .required()
              .positive()
              .like("[1 m, 0.1 m, 0.1 m]"));
    visit(base::field("divisions", divisions, "number of elements along x, y, z")
              .required()
              .positive()
              .like("[110, 2, 2]"));
    element_fields(visit);
  }
};

/// A mesh of solid elements that the program generates, made a body.
struct MeshSpec {
  static constexpr const char* kKey = "mesh";
  static constexpr const char* kDoc = "flexible body: a generated mesh of solid elements";
  SourceLocation where;
  std::variant<BoxMeshSpec> shape;
  base::Reference<MaterialSpec> material;
  std::vector<PointMassSpec> masses;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::inlined(shape, "shape of the mesh").required());
    visit(base::field("material", material, "material: a name from `materials` or written in place")
              .required()
              .like("steel"));
    visit(base::field("masses", masses, "point masses at named nodes"));
  }
};

}  // namespace buckens::fem
