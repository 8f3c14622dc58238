// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "buckens/fem/mesh/cylinder.h"
#include "buckens/fem/mesh/mesh_file_spec.h"
#include "buckens/fem/shell/spec.h"
#include "buckens/fem/solid/element_spec.h"
#include "buckens/fem/structure_spec.h"

namespace buckens::fem {

/// A block with edges along the model axes, divided regularly.
struct BoxMeshSpec : SolidElementSpec {
  static constexpr const char* kKey = "box";
  static constexpr const char* kDoc = "block with edges along the model axes, divided regularly";
  SourceLocation where;
  Eigen::Vector3d from = Eigen::Vector3d::Zero();  ///< corner with the smallest coordinates [m]
  Eigen::Vector3d size = Eigen::Vector3d::Ones();  ///< edge lengths [m]
  std::array<int, 3> divisions = {1, 1, 1};        ///< elements along x, y, z

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("from", from, "corner with the smallest coordinates, in model axes")
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

/// Common to all round solids.
struct RoundMeshSpec : SolidElementSpec {
  std::array<int, 3> divisions = {1, 8, 1};

  template <class Visitor>
  void round_fields(Visitor& visit) {
    visit(
        base::field(
            "divisions", divisions,
            "number of elements in radial, circumferential and axial direction; without a bore the "
            "first counts the rings around a square core, and the second must be divisible by 4")
            .required()
            .positive()
            .like("[1, 8, 20]"));
    element_fields(visit);
  }
};

/// Common to round solids between two points.
struct StraightRoundMeshSpec : RoundMeshSpec {
  Eigen::Vector3d from = Eigen::Vector3d::Zero();  ///< centre of the bottom [m]
  Eigen::Vector3d to = Eigen::Vector3d::Zero();    ///< centre of the top [m]

  template <class Visitor>
  void end_fields(Visitor& visit) {
    visit(base::field("from", from, "centre of the face `bottom`, in model axes")
              .in(base::kLength)
              .like("[0, 0, 0]"));
    visit(base::field("to", to, "centre of the face `top`, in model axes")
              .in(base::kLength)
              .required()
              .like("[300 mm, 0, 0]"));
  }
};

/// A straight round bar.
struct CylinderMeshSpec : StraightRoundMeshSpec {
  static constexpr const char* kKey = "cylinder";
  static constexpr const char* kDoc = "round bar between two points";
  SourceLocation where;
  double diameter = 0;  ///< [m]

  Cylinder shape() const { return {from, to, 0.5 * diameter, 0.0, divisions}; }

  template <class Visitor>
  void fields(Visitor& visit) {
    end_fields(visit);
    visit(base::field("diameter", diameter, "diameter")
              .in(base::kLength)
              .required()
              .positive()
              .like("20 mm"));
    round_fields(visit);
  }
};

/// A straight round tube.
struct TubeMeshSpec : StraightRoundMeshSpec {
  static constexpr const char* kKey = "tube";
  static constexpr const char* kDoc = "round tube between two points";
  SourceLocation where;
  double outer_diameter = 0;  ///< [m]
  double inner_diameter = 0;  ///< [m]

  Cylinder shape() const {
    return {from, to, 0.5 * outer_diameter, 0.5 * inner_diameter, divisions};
  }

  template <class Visitor>
  void fields(Visitor& visit) {
    end_fields(visit);
    visit(base::field("outer-diameter", outer_diameter, "outer diameter")
              .in(base::kLength)
              .required()
              .positive()
              .like("30 mm"));
    visit(base::field("inner-diameter", inner_diameter, "inner diameter")
              .in(base::kLength)
              .required()
              .positive()
              .like("26 mm"));
    round_fields(visit);
  }
};

/// A plane disc, with or without a bore.
struct DiscMeshSpec : RoundMeshSpec {
  static constexpr const char* kKey = "disc";
  static constexpr const char* kDoc = "plane disc about a centre, with or without a bore";
  SourceLocation where;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();   ///< any non-zero length
  double diameter = 0;                               ///< [m]
  double bore = 0;                                   ///< [m]
  double thickness = 0;                              ///< [m]

  Cylinder shape() const {
    const Eigen::Vector3d half = 0.5 * thickness * axis.normalized();
    return {centre - half, centre + half, 0.5 * diameter, 0.5 * bore, divisions};
  }

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("centre", centre, "middle of the disc, in model axes")
              .in(base::kLength)
              .like("[0, 0, 0]"));
    visit(base::field("axis", axis,
                      "direction from the face `bottom` to the face `top`, in model "
                      "axes")
              .like("[0, 0, 1]"));
    visit(base::field("diameter", diameter, "outer diameter")
              .in(base::kLength)
              .required()
              .positive()
              .like("200 mm"));
    visit(base::field("bore", bore, "inner diameter, zero without a bore")
              .in(base::kLength)
              .non_negative()
              .like("30 mm"));
    visit(base::field("thickness", thickness, "thickness")
              .in(base::kLength)
              .required()
              .positive()
              .like("10 mm"));
    round_fields(visit);
  }
};

/// A body with a mesh that is generated or read from a file.
struct MeshSpec : GroupMaterials {
  static constexpr const char* kKey = "mesh";
  static constexpr const char* kDoc = "flexible body: a mesh, generated or from a file";
  SourceLocation where;
  std::variant<BoxMeshSpec, CylinderMeshSpec, TubeMeshSpec, DiscMeshSpec, PlateMeshSpec,
               MeshFileSpec>
      shape;
  std::optional<LengthUnit> length_unit;
  std::optional<MassUnit> mass_unit;
  std::vector<std::string> only, skip;

  bool is_file() const { return std::holds_alternative<MeshFileSpec>(shape); }
  LengthUnit unit_of_length() const { return length_unit.value_or(LengthUnit::m); }
  /// Tonnes suit millimetres: forces are then in N and stresses in MPa.
  MassUnit unit_of_mass() const {
    return mass_unit.value_or(unit_of_length() == LengthUnit::mm ? MassUnit::t : MassUnit::kg);
  }

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::inlined(shape, "shape of the mesh, or its file").required());
    visit(base::field("length-unit", length_unit, "of a file: its unit of length")
              .like("mm")
              .otherwise("m"));
    visit(base::field("mass-unit", mass_unit,
                      "of a file: unit of mass in its constants; time is in seconds")
              .like("t")
              .otherwise("t with millimetres, so that stresses are in MPa; else kg"));
    visit(base::field("only", only,
                      "of a file: element sets, physical groups, instances or properties to use, "
                      "instead of everything; links to the rest are left out")
              .like("HOUSING")
              .otherwise("everything in the file"));
    visit(base::field("skip", skip,
                      "of a file: keywords, cards and element types to leave out although they "
                      "have mass or stiffness; the notes and `trust` tell how many there were")
              .like("[CELAS2, NONSTRUCTURAL MASS]")
              .otherwise("nothing; what is not supported is refused"));
    visit(
        base::field("integration", integration,
                    "of a file: integration of its hex8; `full` uses the shape functions only, "
                    "like C3D8 of other programs. Generated shapes have their own key of this name")
            .like("full")
            .otherwise("incompatible-modes"));
    material_fields(visit);
    section_fields(visit);
    visit(base::field("masses", masses,
                      "point masses at named nodes; those of a file are `n` and the number"));
    visit(base::field("links", links,
                      "of a file: rigid links, averages, equations and springs between nodes, "
                      "written `n` and the number"));
  }
};

}  // namespace buckens::fem
