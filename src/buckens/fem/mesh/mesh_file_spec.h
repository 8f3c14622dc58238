// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "buckens/base/field.h"
#include "buckens/fem/constraint/link_spec.h"
#include "buckens/fem/element/material_spec.h"
#include "buckens/fem/mesh/group_section_spec.h"
#include "buckens/fem/mesh/imported_mesh.h"
#include "buckens/fem/mesh/region_spec.h"
#include "buckens/fem/structure_spec.h"

namespace buckens::fem {

/// Length units of mesh files, which do not state their own.
enum class LengthUnit { m, dm, cm, mm, um, inch, foot };

constexpr std::array<const char*, 7> choice_names(LengthUnit) {
  return {"m", "dm", "cm", "mm", "um", "in", "ft"};
}

/// [m]
constexpr double size_of(LengthUnit unit) {
  constexpr std::array<double, 7> sizes = {1.0, 0.1, 0.01, 1e-3, 1e-6, 0.0254, 0.3048};
  return sizes[static_cast<std::size_t>(unit)];
}

/// Mass units of mesh files.
enum class MassUnit { kg, t, g, lb, slinch };

constexpr std::array<const char*, 5> choice_names(MassUnit) {
  return {"kg", "t", "g", "lb", "slinch"};
}

/// [kg]; a slinch is 1 lbf s²/in.
constexpr double size_of(MassUnit unit) {
  constexpr std::array<double, 5> sizes = {1.0, 1000.0, 1e-3, 0.45359237, 175.126835246};
  return sizes[static_cast<std::size_t>(unit)];
}

/// The material of one part of a mesh file.
struct GroupMaterialSpec {
  static constexpr bool kHasForeignName = true;  ///< any characters
  std::string name;                              ///< of the property, element set or physical group
  SourceLocation where;
  base::Reference<MaterialSpec> material;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("material", material, "material: a name from `materials` or written in place")
              .required()
              .shorthand()
              .like("steel"));
  }
};

/// A mesh file of another program.
struct MeshFileSpec {
  static constexpr const char* kKey = "file";
  static constexpr const char* kDoc =
      "mesh from a file of Gmsh (.msh, .unv), Abaqus or CalculiX (.inp) or Nastran (.bdf, .dat, "
      ".nas, .nastran, .fem)";
  SourceLocation where;
  std::string path;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("path", path, "name of the file, relative to the model file")
              .required()
              .shorthand()
              .like("housing.inp"));
  }
};

/// Additions of a model file to an imported mesh: materials, sections, point masses and links.
struct GroupMaterials {
  // In mesh_file_spec.cpp, because they reach through all members: two to five seconds of compiling
  // each.
  GroupMaterials();
  GroupMaterials(const GroupMaterials&);
  GroupMaterials(GroupMaterials&&) noexcept;
  GroupMaterials& operator=(const GroupMaterials&);
  GroupMaterials& operator=(GroupMaterials&&) noexcept;
  ~GroupMaterials();

  std::optional<base::Reference<MaterialSpec>> material;
  std::vector<GroupMaterialSpec> materials;
  std::optional<GroupSectionSpec> section;
  std::vector<GroupSectionSpec> sections;
  std::vector<PointMassSpec> masses;
  std::optional<StructureLinksSpec> links;
  std::optional<SolidIntegration> integration;  ///< of the hex8; default: SolidForm::usual
  /// In SI units; set by the reader of model files.
  std::shared_ptr<const ImportedMesh> imported;

  template <class Visitor>
  void material_fields(Visitor& visit) {
    visit(base::field("material", material,
                      "material: a name from `materials` or written in place; of a file: for all "
                      "elements without one in `materials` here or in the file")
              .like("steel")
              .otherwise("that of the file"));
    visit(base::field("materials", materials,
                      "of a file: material by the name of an element set, a physical group or a "
                      "property; overrides that of the file")
              .like("{HOUSING: steel, LID: aluminium}")
              .otherwise("those of the file"));
  }

  template <class Visitor>
  void section_fields(Visitor& visit) {
    visit(base::field("section", section,
                      "of a file: for all shells, or all lines, without one in `sections` here or "
                      "in the file")
              .like("{thickness: 2 mm}")
              .otherwise("that of the file"));
    visit(base::field("sections", sections,
                      "of a file: thickness or layers of shells, cross-sections of beams and bars, "
                      "by the name of an element set, a physical group or a property; overrides "
                      "that of the file. A physical group with a section becomes elements even "
                      "where it lies on others: a skin on solids, ribs on a plate")
              .like("{skin: {thickness: 2 mm}, ribs: {beam: {rectangle: {width: 5 mm, height: 20 "
                    "mm}}}}")
              .otherwise("those of the file"));
  }
};

/// The faces of a STEP file with a given colour.
struct FaceColorSpec {
  static constexpr const char* kKey = "color";
  static constexpr const char* kDoc = "the faces that have this colour in the STEP file";
  SourceLocation where;
  std::array<int, 3> rgb = {0, 0, 0};  ///< 0 … 255, as shown by CAD programs

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("rgb", rgb, "red, green and blue, from 0 to 255")
              .required()
              .shorthand()
              .non_negative()
              .like("[255, 0, 0]"));
  }
};

/// Faces of a STEP file by their numbers in it.
struct FaceNumbersSpec {
  static constexpr const char* kKey = "numbers";
  static constexpr const char* kDoc = "faces by number, as `buckens mesh-info` lists them";
  SourceLocation where;
  std::vector<int> numbers;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("numbers", numbers, "numbers of faces")
              .required()
              .shorthand()
              .positive()
              .like("[3, 4]"));
  }
};

/// Faces of a STEP file by their name in it.
struct FaceLabelSpec {
  static constexpr const char* kKey = "label";
  static constexpr const char* kDoc = "the faces that have this name in the STEP file";
  SourceLocation where;
  std::string label;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("label", label, "the name in the file")
              .required()
              .shorthand()
              .like("bearing seat"));
  }
};

/// Named faces of a STEP file for interfaces and loads. By position: faces completely inside the
/// sphere, box or cylinder, or in the plane.
struct GeometryFaceSpec {
  std::string name;
  SourceLocation where;
  std::variant<FaceLabelSpec, FaceColorSpec, FaceNumbersSpec, SphereSelection, BoxSelection,
               CylinderSelection, PlaneSelection>
      selection;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::inlined(selection, "which faces belong to it").required());
  }
};

/// A body from a part in a STEP file, meshed by Gmsh.
struct GeometrySpec : GroupMaterials {
  static constexpr const char* kKey = "geometry";
  static constexpr const char* kDoc = "flexible body: a part from a STEP file, meshed with Gmsh";
  SourceLocation where;
  std::string step;
  std::optional<double> size;  ///< of the elements [m]; default: chosen when meshing
  int order = 2;
  std::string solid;  ///< name or number of one solid; empty: all
  std::vector<GeometryFaceSpec> faces;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("step", step, "name of the STEP file, relative to the model file")
              .required()
              .like("rod.step"));
    visit(base::field("size", size,
                      "edge length of the elements; default: a twentieth of the part's diagonal, "
                      "less where walls are thin")
              .in(base::kLength)
              .positive()
              .like("5 mm"));
    visit(base::field("order", order, "1: tet4; 2: tet10 with mid-side nodes on the true surface"));
    visit(base::field(
              "solid", solid,
              "one solid of the file, by its name or number; default: all, glued where they touch")
              .like("shaft"));
    visit(base::field("faces", faces,
                      "names for faces, used as `face:` of interfaces and loads; by label, colour, "
                      "number or position")
              .like("{bore: {color: [255, 0, 0]}}"));
    material_fields(visit);
    visit(base::field("masses", masses, "point masses at nodes, written `n` and the number"));
  }
};

}  // namespace buckens::fem
