// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/imported_structure.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/fem/assembly/assemble.h"

namespace buckens::model {
namespace {

fem::MaterialSpec material(const std::string& name, double E, double rho) {
  fem::MaterialSpec out;
  out.name = name;
  out.E = E;
  out.nu = 0.3;
  out.rho = rho;
  return out;
}

/// Two unit cubes in a row along x in millimetres, nodes numbered from 101, and a node that nothing
/// uses. The deck has steel for both; the second cube is the element set LID.
fem::ImportedMesh two_cubes() {
  fem::ImportedMesh mesh;
  mesh.file = "part.inp";
  for (int i = 0; i < 3; ++i) {
    for (const auto& [y, z] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
      mesh.node_ids.push_back(101 + mesh.num_nodes());
      mesh.positions.emplace_back(i, y, z);
    }
  }
  mesh.node_ids.push_back(999);
  mesh.positions.emplace_back(50, 0, 0);
  fem::ImportedBlock block;
  block.kind = fem::CellKind::hex8;
  block.source = "C3D8";
  block.property = 0;
  block.ids = {1, 2};
  block.nodes = {0, 1, 2, 3, 4, 5, 6, 7, 4, 5, 6, 7, 8, 9, 10, 11};
  mesh.blocks = {block};
  fem::ImportedProperty property;
  property.name = "HOUSING";
  property.material = "STEEL";
  mesh.properties = {property};
  mesh.materials = {material("STEEL", 210000, 7.85e-9)};  // t, mm, s
  mesh.node_sets = {{"END", {8, 9, 10, 11}}};
  mesh.element_sets = {{"LID", {1}}};
  mesh.face_sets = {{"TIP", {{1, {11, 10, 9, 8}}}}};
  mesh.masses = {{8, 2e-9, Eigen::Matrix3d::Zero(), Eigen::Vector3d::Zero()}};
  return fem::in_si(std::move(mesh), 1e-3, 1e3);
}

fem::GroupMaterialSpec group(const std::string& name, const fem::MaterialSpec& spec) {
  fem::GroupMaterialSpec out;
  out.name = name;
  out.where = {"model.yaml", 7, 3};
  out.material.value = spec;
  return out;
}

ImportedStructure imported(const fem::ImportedMesh& mesh, const fem::GroupMaterials& materials) {
  return imported_structure(mesh, materials, std::nullopt, {"model.yaml", 5, 3});
}

std::string message(const fem::ImportedMesh& mesh, const fem::GroupMaterials& materials) {
  try {
    imported(mesh, materials);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ImportedStructure, TakesUnitsAndMaterialsOfTheFile) {
  const ImportedStructure out = imported(two_cubes(), {});
  EXPECT_EQ(out.structure.nodes.size(), 12U) << "the unused node is left out";
  EXPECT_EQ(out.numbers.at(112), 11);
  EXPECT_FALSE(out.numbers.contains(999));
  ASSERT_EQ(out.structure.solids.num_elements(), 2);
  EXPECT_NEAR(out.structure.solids.material(0)->E, 210e9, 1.0);
  const fem::FeModel fe = fem::assemble(out.structure);
  EXPECT_NEAR(fe.shape.mass, 2 * 7850e-9 + 2e-6, 1e-18);
  EXPECT_NEAR(fe.shape.com.y(), (2 * 7850e-9 * 5e-4) / fe.shape.mass, 1e-12);
}

TEST(ImportedStructure, KeepsSets) {
  const fem::Structure out = imported(two_cubes(), {}).structure;
  EXPECT_EQ(out.node_sets.at(0).nodes, (std::vector<int>{8, 9, 10, 11}));
  EXPECT_EQ(out.element_sets.at(0).solids, (std::vector<int>{1}));
  const fem::FaceIntegrals face =
      fem::face_integrals(out.solids, out.nodes, out.face_sets.at(0).faces.at(0));
  EXPECT_NEAR(face.area.sum(), 1e-6, 1e-18);
  EXPECT_NEAR(face.normal.row(0).sum(), 1e-6, 1e-18) << "outwards, along +x";
}

TEST(ImportedStructure, MaterialsOfTheModelStandAboveThoseOfTheFile) {
  fem::GroupMaterials given;
  given.materials = {group("LID", material("al", 70e9, 2700))};
  const fem::Structure by_set = imported(two_cubes(), given).structure;
  EXPECT_NEAR(by_set.solids.material(0)->E, 210e9, 1.0);
  EXPECT_EQ(by_set.solids.material(1)->E, 70e9);
  given.materials = {group("HOUSING", material("al", 70e9, 2700))};
  EXPECT_EQ(imported(two_cubes(), given).structure.solids.material(0)->E, 70e9);
}

TEST(ImportedStructure, OrthotropicSolidsLieInTheAxesOfTheirProperty) {
  fem::ImportedMesh mesh = two_cubes();
  fem::OrthotropicSpec wood;
  wood.E1 = 10e9;
  wood.E2 = wood.E3 = 1e9;
  wood.G12 = wood.G13 = wood.G23 = 0.5e9;
  mesh.materials[0].orthotropic = wood;
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  EXPECT_EQ(imported(mesh, {}).structure.solids.material(0)->orthotropy->axes.col(0), x);
  mesh.properties[0].axes = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const auto turned = imported(mesh, {}).structure.solids.material(0)->orthotropy;
  EXPECT_LT((turned->axes - *mesh.properties[0].axes).norm(), 1e-15);
  // Materials of the model replace that of the file, in the same axes or in their own.
  fem::MaterialSpec spruce = material("spruce", 0, 450);
  spruce.orthotropic = wood;
  fem::GroupMaterials given;
  given.materials = {group("HOUSING", spruce)};
  const auto same = imported(mesh, given).structure.solids.material(0)->orthotropy;
  EXPECT_LT((same->axes - *mesh.properties[0].axes).norm(), 1e-15);
  spruce.orthotropic->axis_1 = Eigen::Vector3d::UnitZ();
  given.materials = {group("HOUSING", spruce)};
  const auto own = imported(mesh, given).structure.solids.material(0)->orthotropy;
  EXPECT_EQ(own->axes.col(0), Eigen::Vector3d::UnitZ());
}

TEST(ImportedStructure, SaysWhatIsMissing) {
  fem::ImportedMesh mesh = two_cubes();
  mesh.properties[0].material.clear();
  EXPECT_EQ(message(mesh, {}),
            "model.yaml:5:3: part.inp: the C3D8 elements of \"HOUSING\" have no material; give "
            "`material`, or `materials` by the name of the property or of an element set");
  fem::GroupMaterials given;
  given.material.emplace().value = material("steel", 2e11, 7850);
  EXPECT_EQ(imported(mesh, given).structure.solids.material(1)->rho, 7850);
  given.materials = {group("HOUSIN", material("al", 70e9, 2700))};
  EXPECT_EQ(message(mesh, given),
            "model.yaml:7:3: part.inp has no property, element set or material \"HOUSIN\". Did "
            "you mean \"HOUSING\"?");
  mesh = two_cubes();
  mesh.face_sets[0].faces[0].corners = {0, 1, 2, 8};
  EXPECT_EQ(message(mesh, {}),
            "model.yaml:5:3: part.inp: surface \"TIP\" has a face that its element does not have");
}

/// A square of two triangles, the group "skin", and its lower edge, the group "rib".
fem::ImportedMesh plate_with_rib() {
  fem::ImportedMesh mesh;
  mesh.file = "plate.msh";
  mesh.node_ids = {1, 2, 3, 4};
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.properties.resize(2);
  mesh.properties[0].name = "skin";
  mesh.properties[0].kind = fem::PropertyKind::shell;
  mesh.properties[1].name = "rib";
  mesh.properties[1].kind = fem::PropertyKind::beam;
  mesh.blocks.resize(2);
  mesh.blocks[0].kind = fem::CellKind::tri3;
  mesh.blocks[0].source = "triangle";
  mesh.blocks[0].property = 0;
  mesh.blocks[0].ids = {1, 2};
  mesh.blocks[0].nodes = {0, 1, 2, 0, 2, 3};
  mesh.blocks[1].kind = fem::CellKind::line2;
  mesh.blocks[1].source = "line";
  mesh.blocks[1].property = 1;
  mesh.blocks[1].ids = {3};
  mesh.blocks[1].nodes = {0, 1};
  mesh.element_sets = {{"skin", {0, 1}}, {"rib", {2}}, {"corner", {1, 2}}};
  return mesh;
}

fem::GroupSectionSpec skin(const std::string& name, double thickness) {
  fem::GroupSectionSpec out;
  out.name = name;
  out.where = {"model.yaml", 8, 5};
  out.thickness = thickness;
  return out;
}

fem::GroupSectionSpec rod(const std::string& name, double diameter) {
  fem::GroupSectionSpec out;
  out.name = name;
  out.where = {"model.yaml", 9, 5};
  out.beam.emplace().value.shape = fem::CircleSpec{diameter};
  return out;
}

TEST(ImportedStructure, TakesSectionsOfTheModel) {
  const fem::ImportedMesh mesh = plate_with_rib();
  fem::GroupMaterials given;
  given.material.emplace().value = material("steel", 2e11, 7850);
  given.section = skin("", 0.01);
  given.sections = {rod("rib", 0.02), skin("corner", 0.005)};
  given.sections[1].offset = 0.001;
  given.sections[1].material.emplace().value = material("al", 7e10, 2700);
  fem::Structure out = imported(mesh, given).structure;
  ASSERT_EQ(out.shells.num_elements(), 2);
  EXPECT_EQ(out.shells.shell_section(0).thickness(), 0.01);
  EXPECT_EQ(out.shells.shell_section(1).thickness(), 0.005);
  EXPECT_EQ(out.shells.shell_section(1).offset, 0.001);
  EXPECT_EQ(out.shells.material(1)->rho, 2700);
  ASSERT_EQ(out.beams.num_elements(), 1) << "the shell's section does not fit the line of `corner`";
  EXPECT_NEAR(out.beams.section(0)->A, 3.14159265 * 1e-4, 1e-11);
  given.sections[0].bar = given.sections[0].beam;
  given.sections[0].beam.reset();
  out = imported(mesh, given).structure;
  EXPECT_EQ(out.beams.num_elements(), 0);
  EXPECT_EQ(out.bars.num_elements(), 1);
}

TEST(ImportedStructure, SaysWhichSectionIsMissing) {
  fem::ImportedMesh mesh = plate_with_rib();
  fem::GroupMaterials given;
  given.material.emplace().value = material("steel", 2e11, 7850);
  EXPECT_EQ(message(mesh, given),
            "model.yaml:5:3: plate.msh: the triangle elements of \"skin\" have no thickness; write "
            "it in the model file beside the name of the mesh file, for example sections: "
            "{\"skin\": {thickness: 2 mm}}");
  given.sections = {skin("skin", 0.01)};
  EXPECT_EQ(message(mesh, given),
            "model.yaml:5:3: plate.msh: the line elements of \"rib\" have no cross-section; write "
            "it in the model file beside the name of the mesh file, for example sections: "
            "{\"rib\": {beam: {circle: {diameter: 6 mm}}}}");
  given.sections = {skin("skin", 0.01), rod("ribs", 0.02)};
  EXPECT_EQ(message(mesh, given),
            "model.yaml:9:5: plate.msh has neither a property nor an element set \"ribs\". Did you "
            "mean \"rib\"?");
  given.sections = {rod("skin", 0.02)};
  EXPECT_EQ(message(mesh, given),
            "model.yaml:9:5: plate.msh: there are no lines in \"skin\" to which this section could "
            "apply");
  mesh.blocks[0].property = -1;
  given.sections = {rod("rib", 0.02)};
  EXPECT_EQ(
      message(mesh, given),
      "model.yaml:5:3: plate.msh: the triangle elements without a property have no thickness; "
      "write it in the model file beside the name of the mesh file, for example section: "
      "{thickness: 2 mm}");
}

TEST(ImportedStructure, KeepsNodesThatTheModelNames) {
  fem::GroupMaterials given;
  given.masses.resize(1);
  given.masses[0].at = "n999";
  EXPECT_TRUE(imported(two_cubes(), given).numbers.contains(999));
}

}  // namespace
}  // namespace buckens::model
