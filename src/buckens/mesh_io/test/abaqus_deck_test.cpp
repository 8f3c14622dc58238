// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <fstream>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/base/field.h"
#include "buckens/base/test/source_directory.h"
#include "buckens/base/test/temporary_directory.h"
#include "buckens/mesh_io/abaqus/deck.h"

namespace buckens::mesh_io {
namespace {

using fem::CellKind;
using fem::ImportedMesh;
using fem::PropertyKind;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

ImportedMesh read(const std::string& name) {
  return read_abaqus_deck(std::string(buckens::test::kSourceDirectory) + "/tests/decks/abaqus/" +
                          name);
}

const fem::ImportedBlock& block_of(const ImportedMesh& mesh, const std::string& source,
                                   const std::string& property = "") {
  for (const auto& block : mesh.blocks) {
    const std::string name =
        block.property < 0 ? "" : mesh.properties[static_cast<std::size_t>(block.property)].name;
    if (block.source == source && (property.empty() || property == name)) return block;
  }
  throw std::runtime_error("no block of " + source);
}

const fem::ImportedProperty& property_called(const ImportedMesh& mesh, const std::string& name) {
  const auto* found = base::find_named(mesh.properties, name);
  if (found == nullptr) throw std::runtime_error("no property " + name);
  return *found;
}

std::vector<std::int64_t> labels(const ImportedMesh& mesh, const std::vector<int>& nodes) {
  std::vector<std::int64_t> out;
  for (const int node : nodes) out.push_back(mesh.node_ids[static_cast<std::size_t>(node)]);
  return out;
}

std::vector<std::int64_t> set_labels(const ImportedMesh& mesh, const std::string& name) {
  const auto* found = base::find_named(mesh.node_sets, name);
  if (found == nullptr) throw std::runtime_error("no node set " + name);
  return labels(mesh, found->nodes);
}

/// Numbers in the deck of the elements of a set.
std::vector<std::int64_t> element_labels(const ImportedMesh& mesh, const std::string& name) {
  const auto* found = base::find_named(mesh.element_sets, name);
  if (found == nullptr) throw std::runtime_error("no element set " + name);
  std::vector<std::int64_t> all;
  for (const auto& block : mesh.blocks) all.insert(all.end(), block.ids.begin(), block.ids.end());
  std::vector<std::int64_t> out;
  for (const int element : found->elements) out.push_back(all[static_cast<std::size_t>(element)]);
  return out;
}

/// The note with these words; count 0 if there is none.
fem::ImportNote note(const ImportedMesh& mesh, const std::string& words) {
  for (const auto& entry : mesh.notes) {
    if (entry.text.find(words) != std::string::npos) return entry;
  }
  return {"", 0, 0};
}

TEST(AbaqusSolids, EveryKindOfSolidArrivesWithItsNodesInOrder) {
  const ImportedMesh mesh = read("solids.inp");
  EXPECT_EQ(mesh.format, "Abaqus");
  EXPECT_EQ(mesh.num_nodes(), 29);
  EXPECT_EQ(mesh.num_elements(), 8);
  EXPECT_EQ(block_of(mesh, "C3D8R").kind, CellKind::hex8);
  EXPECT_EQ(block_of(mesh, "C3D8I").kind, CellKind::hex8);
  EXPECT_EQ(block_of(mesh, "C3D20R").kind, CellKind::hex20);
  EXPECT_EQ(block_of(mesh, "C3D4").kind, CellKind::tet4);
  EXPECT_EQ(block_of(mesh, "C3D10").kind, CellKind::tet10);
  EXPECT_EQ(block_of(mesh, "C3D6").kind, CellKind::wedge6);
  EXPECT_EQ(block_of(mesh, "C3D15").kind, CellKind::wedge15);
  EXPECT_EQ(block_of(mesh, "C3D5").kind, CellKind::pyramid5);
  // The connectivity goes on over two lines, and the order stays that of the deck.
  EXPECT_THAT(labels(mesh, block_of(mesh, "C3D20R").nodes),
              ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32));
  EXPECT_THAT(labels(mesh, block_of(mesh, "C3D5").nodes), ElementsAre(1, 2, 3, 4, 9));
  EXPECT_EQ(mesh.positions[static_cast<std::size_t>(block_of(mesh, "C3D8R").nodes[6])],
            Eigen::Vector3d(10, 10, 10));
}

TEST(AbaqusSolids, FullIntegrationAndPlainTrianglesNeedNoNote) {
  const ImportedMesh mesh = read("kinds.inp");
  EXPECT_EQ(block_of(mesh, "C3D20").kind, CellKind::hex20);
  EXPECT_EQ(block_of(mesh, "S3").kind, CellKind::tri3);
  EXPECT_EQ(note(mesh, "C3D20").count, 0);
}

TEST(AbaqusSolids, SetsAddUpAndMayHoldSetsRangesAndNodesOfElements) {
  const ImportedMesh mesh = read("solids.inp");
  EXPECT_THAT(set_labels(mesh, "BOTTOM"), ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(set_labels(mesh, "EVEN"), ElementsAre(2, 4, 6, 8));
  EXPECT_THAT(set_labels(mesh, "MIXED"), ElementsAre(1, 2, 3, 4, 9, 10));
  EXPECT_THAT(set_labels(mesh, "OfBlock"), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 10, 11, 12, 13));
  EXPECT_EQ(set_labels(mesh, "ALL").size(), 29u);
  // "Block" and "BLOCK" are one set, under the name that came first.
  EXPECT_THAT(element_labels(mesh, "Block"), UnorderedElementsAre(1, 8));
  EXPECT_THAT(element_labels(mesh, "BOTH"), UnorderedElementsAre(1, 6, 8));
  EXPECT_THAT(element_labels(mesh, "RANGE"), UnorderedElementsAre(1, 3, 4, 5, 6, 7, 8));
  EXPECT_THAT(set_labels(mesh, "POINTS"), ElementsAre(1, 2, 3, 4, 9));
}

TEST(AbaqusSolids, SurfacesAreFacesByTheirCorners) {
  const ImportedMesh mesh = read("solids.inp");
  const auto* under = base::find_named(mesh.face_sets, std::string("UNDER"));
  ASSERT_NE(under, nullptr);
  ASSERT_EQ(under->faces.size(), 1u);
  EXPECT_THAT(labels(mesh, under->faces[0].corners), ElementsAre(1, 2, 3, 4));
  // Free faces: those not shared with another solid of the deck. Element 1 shares its lower face
  // with the element of 20 nodes and others, and all the other ones, too; element 8 stands on it.
  const auto* outside = base::find_named(mesh.face_sets, std::string("Outside"));
  ASSERT_NE(outside, nullptr);
  EXPECT_EQ(outside->faces.size(), 5u);
}

TEST(AbaqusSolids, SectionsGiveMaterialsAndAxes) {
  const ImportedMesh mesh = read("solids.inp");
  EXPECT_EQ(property_called(mesh, "BLOCK").material, "Steel");
  const auto& wood = property_called(mesh, "Quadratic block");
  EXPECT_EQ(wood.kind, PropertyKind::solid);
  // Axis 1 along y, axis 2 along -x, then 90 degrees about axis 3.
  ASSERT_TRUE(wood.axes.has_value());
  Eigen::Matrix3d expected;
  expected << -1, 0, 0, 0, -1, 0, 0, 0, 1;
  EXPECT_LT((*wood.axes - expected).norm(), 1e-15);
  EXPECT_EQ(block_of(mesh, "C3D15").property, -1);
}

TEST(AbaqusMaterials, ConstantsOfAllTypesAreTaken) {
  const ImportedMesh mesh = read("solids.inp");
  const auto* steel = base::find_named(mesh.materials, std::string("Steel"));
  ASSERT_NE(steel, nullptr);
  EXPECT_EQ(steel->E, 210000.0);
  EXPECT_EQ(steel->nu, 0.3);
  EXPECT_EQ(steel->rho, 7.85e-9);
  ASSERT_TRUE(steel->damping.has_value());
  EXPECT_EQ(steel->damping->mass, 2.5);
  EXPECT_EQ(steel->damping->stiffness, 1e-6);
  const auto* wood = base::find_named(mesh.materials, std::string("WOOD"));
  ASSERT_TRUE(wood != nullptr && wood->orthotropic);
  EXPECT_EQ(wood->orthotropic->E2, 800.0);
  EXPECT_EQ(wood->orthotropic->nu13, 0.4);
  EXPECT_EQ(wood->orthotropic->G23, 60.0);
  // The stiffnesses in the deck are those of E = 100 000, nu = 0.3, with fifteen digits.
  const auto* rubber = base::find_named(mesh.materials, std::string("RUBBER"));
  ASSERT_TRUE(rubber != nullptr && rubber->orthotropic);
  EXPECT_NEAR(rubber->orthotropic->E1, 1e5, 1e-8);
  EXPECT_NEAR(rubber->orthotropic->E3, 1e5, 1e-8);
  EXPECT_NEAR(rubber->orthotropic->nu23, 0.3, 1e-13);
  EXPECT_NEAR(rubber->orthotropic->G12, 1e5 / 2.6, 1e-8);
}

TEST(AbaqusNotes, WhatIsLeftOutOrBecomesSomethingElseIsSaid) {
  const ImportedMesh mesh = read("solids.inp");
  EXPECT_EQ(note(mesh, "*STEP").count, 2);
  EXPECT_THAT(note(mesh, "*STEP").text, HasSubstr("model file"));
  EXPECT_THAT(note(mesh, "*BOUNDARY").text, HasSubstr("model file"));
  EXPECT_EQ(note(mesh, "*EXPANSION is ignored").count, 1);
  EXPECT_EQ(note(mesh, "*FREQUENCY").count, 0);  // within a step
  EXPECT_THAT(note(mesh, "C3D8R").text, HasSubstr("hex8 with incompatible modes"));
  EXPECT_EQ(note(mesh, "C3D8R").line, 6);
  EXPECT_EQ(note(mesh, "several temperatures").count, 1);
  EXPECT_EQ(note(mesh, "type C3D15 without a section").count, 1);
}

TEST(AbaqusShells, ThicknessOffsetLayersAndSidesAreTaken) {
  const ImportedMesh mesh = read("lines.inp");
  const auto& plate = property_called(mesh, "PLATE");
  EXPECT_EQ(plate.kind, PropertyKind::shell);
  EXPECT_EQ(plate.thickness, 0.02);
  EXPECT_DOUBLE_EQ(plate.offset, -0.01);  // the nodes lie on the upper side
  EXPECT_EQ(block_of(mesh, "S4R").kind, CellKind::quad4);
  EXPECT_EQ(block_of(mesh, "S3R").kind, CellKind::tri3);
  EXPECT_EQ(block_of(mesh, "STRI3").kind, CellKind::tri3);
  const auto& laminate = property_called(mesh, "LAMINATE");
  ASSERT_EQ(laminate.layers.size(), 3u);
  EXPECT_EQ(laminate.layers[1].material, "PLY");
  EXPECT_EQ(laminate.layers[1].thickness, 0.002);
  EXPECT_DOUBLE_EQ(laminate.layers[1].angle, std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ(laminate.offset, 0.001);
  EXPECT_TRUE(laminate.axes.has_value());
  const auto* top = base::find_named(mesh.face_sets, std::string("TOP"));
  const auto* under = base::find_named(mesh.face_sets, std::string("UNDERSIDE"));
  ASSERT_TRUE(top != nullptr && under != nullptr);
  EXPECT_THAT(labels(mesh, top->faces[0].corners), ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(labels(mesh, under->faces[0].corners), ElementsAre(4, 3, 2, 1));
  // An edge has nodes but no face.
  EXPECT_THAT(set_labels(mesh, "RIM"), ElementsAre(1, 2));
}

TEST(AbaqusBeams, SectionsAndDirectionsAreTaken) {
  const ImportedMesh mesh = read("lines.inp");
  const auto& rectangle = property_called(mesh, "RECTANGLE");
  const auto& shape = std::get<fem::RectangleSpec>(rectangle.section->shape);
  EXPECT_EQ(shape.width, 0.04);   // along n1, our y
  EXPECT_EQ(shape.height, 0.06);  // along n2, our z
  const auto& beams = block_of(mesh, "B31", "RECTANGLE");
  ASSERT_EQ(beams.up.size(), 2u);
  EXPECT_EQ(beams.up[0], Eigen::Vector3d(0, 0, 1));  // x × y
  // Node 100 at (0, 5, 0) gives n1 of the second beam, from (1, 0, 0).
  EXPECT_LT((beams.up[1] - Eigen::Vector3d(0, 0, 1)).norm(), 1e-15);
  EXPECT_EQ(std::get<fem::TubeSpec>(property_called(mesh, "PIPE").section->shape).outer_diameter,
            0.1);
  EXPECT_EQ(std::get<fem::CircleSpec>(property_called(mesh, "ROUND").section->shape).diameter,
            0.06);
  EXPECT_EQ(std::get<fem::BoxSpec>(property_called(mesh, "BOX").section->shape).thickness, 0.004);
  const auto& general =
      std::get<fem::GeneralSectionSpec>(property_called(mesh, "GENERAL").section->shape);
  EXPECT_EQ(general.A, 0.001);
  EXPECT_EQ(general.Iy, 2e-6);  // I11: bending about n1, our y
  EXPECT_EQ(general.Iz, 3e-6);
  const auto* own = base::find_named(mesh.materials, property_called(mesh, "GENERAL").material);
  ASSERT_NE(own, nullptr);
  EXPECT_EQ(own->E, 70e9);
  EXPECT_EQ(own->G, 26e9);
  EXPECT_EQ(own->rho, 2700.0);
}

TEST(AbaqusBeams, SectionsOfOneNameInTwoPartsKeepTheirMaterials) {
  const ImportedMesh mesh = read("beam_parts.inp");
  ASSERT_EQ(mesh.properties.size(), 2u);
  std::vector<double> moduli;
  for (const auto& property : mesh.properties) {
    moduli.push_back(base::find_named(mesh.materials, property.material)->E);
  }
  EXPECT_THAT(moduli, ElementsAre(70e9, 210e9));
  // The third node lies beside the first; both halves of a quadratic beam look from there.
  const auto& beams = block_of(mesh, "B32");
  ASSERT_EQ(beams.up.size(), 2u);
  EXPECT_LT((beams.up[0] - Eigen::Vector3d(0, -1, 1).normalized()).norm(), 1e-15);
  EXPECT_LT((beams.up[1] - Eigen::Vector3d(0.5, -1, 1).normalized()).norm(), 1e-15);
}

TEST(AbaqusBeams, WallsOfTwoThicknessesGiveTheConstantsOfTheBox) {
  const ImportedMesh mesh = read("lines.inp");
  const auto& box =
      std::get<fem::GeneralSectionSpec>(property_called(mesh, "THICKBOX").section->shape);
  EXPECT_NEAR(box.A, 0.05 * 0.08 - 0.042 * 0.068, 1e-18);
  EXPECT_NEAR(box.Iy, (0.05 * std::pow(0.08, 3) - 0.042 * std::pow(0.068, 3)) / 12, 1e-18);
  EXPECT_NEAR(box.Iz, (0.08 * std::pow(0.05, 3) - 0.068 * std::pow(0.042, 3)) / 12, 1e-18);
}

TEST(AbaqusBeams, QuadraticLinesBecomeTwoAndTrussesBars) {
  const ImportedMesh mesh = read("lines.inp");
  const auto& round = block_of(mesh, "B32");
  EXPECT_EQ(round.kind, CellKind::line2);
  EXPECT_THAT(labels(mesh, round.nodes), ElementsAre(1, 8, 8, 7));
  EXPECT_THAT(element_labels(mesh, "ROUND"), ElementsAre(14, 14));
  const auto& strut = property_called(mesh, "STRUT");
  EXPECT_EQ(strut.kind, PropertyKind::bar);
  const double d = std::get<fem::CircleSpec>(strut.section->shape).diameter;
  EXPECT_NEAR(std::numbers::pi / 4 * d * d, 0.0005, 1e-18);
  EXPECT_EQ(property_called(mesh, "PIPE").shear_flexible, false);  // B33
  EXPECT_EQ(property_called(mesh, "ROUND").shear_flexible, true);
  EXPECT_EQ(note(mesh, "B33").count, 1);
  EXPECT_THAT(note(mesh, "B32").text, HasSubstr("two straight"));
}

TEST(AbaqusMasses, MassesAndInertiasSitOnTheirNodes) {
  const ImportedMesh mesh = read("lines.inp");
  ASSERT_EQ(mesh.masses.size(), 2u);
  EXPECT_EQ(mesh.masses[0].mass, 2.5);
  EXPECT_EQ(mesh.node_ids[static_cast<std::size_t>(mesh.masses[0].node)], 10);
  // Axis 1 of the orientation is y, axis 2 is -x.
  const Eigen::Vector3d diagonal = mesh.masses[1].inertia.diagonal();
  EXPECT_LT((diagonal - Eigen::Vector3d(0.2, 0.1, 0.3)).norm(), 1e-15);
  EXPECT_THAT(note(mesh, "SPRING1").text, HasSubstr("left out"));
}

TEST(AbaqusAssembly, InstancesAreMovedThenTurned) {
  const ImportedMesh mesh = read("assembly.inp");
  EXPECT_EQ(mesh.num_nodes(), 1 + 8 + 8 + 4);
  // Numbers of instances would collide, so they are shifted.
  EXPECT_THAT(set_labels(mesh, "Pin-1.Top"), ElementsAre(15, 16, 17, 18));
  EXPECT_THAT(set_labels(mesh, "Pin-2.Top"), ElementsAre(25, 26, 27, 28));
  EXPECT_THAT(note(mesh, "Pin-2").text, HasSubstr("node 12 is n32"));
  // Node 2 of Pin-2: (1, 0, 0) moved to (6, 0, 0), turned by 90 degrees about z at x = 5.
  const auto node = static_cast<std::size_t>(1 + 8 + 1);
  EXPECT_EQ(mesh.node_ids[node], 22);
  EXPECT_LT((mesh.positions[node] - Eigen::Vector3d(5, 1, 0)).norm(), 1e-14);
  EXPECT_EQ(mesh.positions.back().z(), -1.0);
}

TEST(AbaqusAssembly, SetsOfTheAssemblyReachIntoInstances) {
  const ImportedMesh mesh = read("assembly.inp");
  EXPECT_THAT(set_labels(mesh, "Heads"), ElementsAre(15, 16, 25, 26, 27, 28));
  EXPECT_THAT(set_labels(mesh, "Reference"), ElementsAre(1));
  // Internal sets are not passed on.
  EXPECT_EQ(base::find_named(mesh.element_sets, std::string("_Upper_S2")), nullptr);
  // One property for both pins, another one for the plate, whose set has the same name.
  ASSERT_EQ(mesh.properties.size(), 2u);
  EXPECT_EQ(mesh.properties[0].name, "Whole");
  EXPECT_EQ(mesh.properties[1].name, "Plate-1.Whole");
  EXPECT_EQ(mesh.properties[1].thickness, 0.1);
}

TEST(AbaqusAssembly, CouplingsBecomeLinksAndAverages) {
  const ImportedMesh mesh = read("assembly.inp");
  ASSERT_EQ(mesh.rigid_links.size(), 5u);  // the coupling and one *MPC BEAM for each of four nodes
  const auto& lead = mesh.rigid_links[0];
  EXPECT_EQ(lead.name, "Lead");
  EXPECT_EQ(mesh.node_ids[static_cast<std::size_t>(lead.reference)], 1);
  EXPECT_THAT(labels(mesh, lead.nodes), ElementsAre(15, 16, 17, 18));
  ASSERT_EQ(mesh.averages.size(), 1u);
  EXPECT_THAT(labels(mesh, mesh.averages[0].nodes), ElementsAre(15, 16, 17, 18));
  // A quarter of the face of size one each; rotations about x and z are released.
  EXPECT_THAT(mesh.averages[0].weights, ElementsAre(0.25, 0.25, 0.25, 0.25));
  EXPECT_THAT(mesh.averages[0].variables, ElementsAre(true, true, true, false, true, false));
  EXPECT_EQ(mesh.node_ids[static_cast<std::size_t>(mesh.rigid_links[1].reference)], 31);
  // The plate lies four units below the pin.
  EXPECT_THAT(note(mesh, "*TIE").text, HasSubstr("not tied"));
  EXPECT_EQ(note(mesh, "*TIE").count, 4);
}

TEST(AbaqusConstraints, MultiPointConstraintsJoinSetsByNumber) {
  const ImportedMesh mesh = read("constraints.inp");
  const auto node = [&](std::size_t k) {
    return mesh.node_ids[static_cast<std::size_t>(mesh.rigid_links[k].nodes[0])];
  };
  EXPECT_EQ(node(0), 2);
  EXPECT_EQ(mesh.node_ids[static_cast<std::size_t>(mesh.rigid_links[0].reference)], 1);
  EXPECT_THAT(note(mesh, "a rigid beam, as in Abaqus").text, HasSubstr("write LINK"));
  // TIE of two nodes with rotations: six equations; PIN of two pairs: six, the pairs by number.
  ASSERT_GE(mesh.equations.size(), 12u);
  EXPECT_EQ(mesh.equations[5].terms[0].variable, 5);
  EXPECT_EQ(mesh.equations[6].terms[0].node, 0);
  EXPECT_EQ(mesh.equations[6].terms[1].node, 2);
  EXPECT_EQ(mesh.equations[9].terms[1].node, 3);
  EXPECT_EQ(mesh.equations[9].terms[1].coefficient, -1.0);
}

ImportedMesh read_text(const std::string& deck) {
  const buckens::test::TemporaryDirectory folder;
  std::ofstream(folder / "deck.inp") << deck;
  return read_abaqus_deck(folder / "deck.inp");
}

TEST(AbaqusConstraints, UnsortedSetsMakePairsAsTheyAreWritten) {
  const std::string nodes =
      "*NODE\n1,0,0,0\n2,1,0,0\n11,0,1,0\n12,1,1,0\n*NSET, NSET=A\n2, 1\n*NSET, NSET=B";
  const auto partners = [](const ImportedMesh& mesh) {
    std::vector<std::pair<std::int64_t, std::int64_t>> out;
    for (const auto& equation : mesh.equations) {
      const auto number = [&](std::size_t k) {
        return mesh.node_ids[static_cast<std::size_t>(equation.terms[k].node)];
      };
      out.emplace_back(number(0), number(1));
    }
    return out;
  };
  using Pair = std::pair<std::int64_t, std::int64_t>;
  const std::string equation = "*EQUATION\n2\nA,1,1.,B,1,-1.\n";
  EXPECT_THAT(partners(read_text(nodes + "\n12, 11\n" + equation)),
              ElementsAre(Pair(1, 11), Pair(2, 12)));
  EXPECT_THAT(partners(read_text(nodes + ", UNSORTED\n12, 11\n" + equation)),
              ElementsAre(Pair(1, 12), Pair(2, 11)));
  const ImportedMesh beams = read_text(nodes + ", UNSORTED\n12,\n11\n*MPC\nBEAM, B, A\n");
  ASSERT_EQ(beams.rigid_links.size(), 2u);
  EXPECT_THAT(labels(beams, beams.rigid_links[0].nodes), ElementsAre(12));
  EXPECT_THAT(labels(beams, {beams.rigid_links[0].reference}), ElementsAre(1));
}

TEST(AbaqusBeams, CirclesAreRadiiOfAbaqusOrDiametersOfCalculix) {
  const std::string beam =
      "*NODE\n1,0,0,0\n2,1,0,0\n*ELEMENT, TYPE=B31, ELSET=E\n1,1,2\n"
      "*BEAM SECTION, ELSET=E, SECTION=CIRC\n";
  const auto diameter = [](const ImportedMesh& mesh) {
    return std::get<fem::CircleSpec>(mesh.properties.at(0).section->shape).diameter;
  };
  const ImportedMesh one = read_text(beam + "0.03\n0,0,-1\n");
  EXPECT_EQ(diameter(one), 0.06);
  EXPECT_THAT(note(one, "the one value is the radius").text, HasSubstr("write it twice"));
  const ImportedMesh two = read_text(beam + "0.03, 0.03\n0,0,-1\n");
  EXPECT_EQ(diameter(two), 0.03);
  EXPECT_EQ(note(two, "two values are the diameters").line, 7);
}

TEST(AbaqusBeams, TwoDiametersAreAnEllipse) {
  const ImportedMesh mesh = read_text(
      "*NODE\n1,0,0,0\n2,1,0,0\n*ELEMENT, TYPE=B31, ELSET=E\n1,1,2\n"
      "*BEAM SECTION, ELSET=E, SECTION=CIRC\n0.05, 0.08\n0,0,-1\n");
  const auto& shape = std::get<fem::GeneralSectionSpec>(mesh.properties.at(0).section->shape);
  const double a = 0.025, b = 0.04;  // semi-axes along y and z
  EXPECT_NEAR(shape.A, std::numbers::pi * a * b, 1e-17);
  EXPECT_NEAR(shape.Iy, std::numbers::pi / 4 * a * b * b * b, 1e-20);
  EXPECT_NEAR(shape.Iz, std::numbers::pi / 4 * a * a * a * b, 1e-20);
  EXPECT_NEAR(shape.J, std::numbers::pi * std::pow(a * b, 3) / (a * a + b * b), 1e-20);
}

TEST(AbaqusBeams, OffsetsPutThemBesideTheirNodes) {
  const ImportedMesh mesh = read_text(
      "*NODE\n1,0,0,0\n2,1,0,0\n3,2,0,0\n*ELEMENT, TYPE=B31, ELSET=E\n1,1,2\n2,2,3\n"
      "*BEAM SECTION, ELSET=E, SECTION=RECT, OFFSET1=0.5, OFFSET2=-1\n0.04, 0.06\n0,0,-1\n");
  // n1 = −z, n2 = x × n1 = y. The nodes lie half a width along n1 and a height against n2 from the
  // centres, so these lie at +0.02 along z and +0.06 along y.
  ASSERT_EQ(mesh.blocks.size(), 1u);
  ASSERT_EQ(mesh.positions.size(), 6u);
  EXPECT_THAT(labels(mesh, mesh.blocks[0].nodes), ElementsAre(4, 5, 5, 6));
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3d expected(static_cast<double>(k), 0.06, 0.02);
    EXPECT_LT((mesh.positions[3 + k] - expected).norm(), 1e-16);
    EXPECT_EQ(mesh.rigid_links.at(k).reference, static_cast<int>(k));
    EXPECT_THAT(mesh.rigid_links[k].nodes, ElementsAre(3 + static_cast<int>(k)));
  }
  EXPECT_THAT(note(mesh, "OFFSET1").text, HasSubstr("additional nodes on rigid links"));
}

TEST(AbaqusNotes, WhatChangesHowPartsHoldTogetherIsRefusedOrSkipped) {
  const std::string deck =
      "*NODE\n1,0,0,0,0,0,1\n2,1,0,0\n*ELEMENT, TYPE=B31, ELSET=E\n1,1,2\n"
      "*BEAM SECTION, ELSET=E, SECTION=RECT\n1,1\n*RELEASE\n1,S1,M1\n";
  EXPECT_THROW(read_text(deck), InputError);
  const buckens::test::TemporaryDirectory folder;
  std::ofstream(folder / "deck.inp") << deck;
  SkipList skip({"Release", "*other"});
  const ImportedMesh mesh = read_abaqus_deck(folder / "deck.inp", skip);
  const auto skipped = skip.notes();
  ASSERT_EQ(skipped.size(), 2u);
  EXPECT_THAT(skipped[0].text, HasSubstr("no \"*other\""));
  EXPECT_THAT(skipped[1].text, HasSubstr("1 of Release left out"));
  EXPECT_TRUE(skipped[1].is_doubtful);
  EXPECT_FALSE(skipped[0].is_doubtful);
  EXPECT_EQ(skipped[1].line, 8);
  EXPECT_EQ(note(mesh, "normals after the coordinates").line, 2);
}

TEST(AbaqusConstraints, LinksKeepTheDistanceOfTheirNodes) {
  const ImportedMesh mesh = read("constraints.inp");
  // Between node 8 at (1, 0, 1) and node 5 at (0, 3, 0): (1, −3, 1)/√11, the largest part first.
  const auto& terms = mesh.equations.at(12).terms;
  ASSERT_EQ(terms.size(), 6u);
  EXPECT_EQ(mesh.node_ids[static_cast<std::size_t>(terms[0].node)], 8);
  EXPECT_EQ(terms[0].variable, 1);
  EXPECT_NEAR(terms[0].coefficient, -3 / std::sqrt(11.0), 1e-15);
  EXPECT_NEAR(terms[1].coefficient, 3 / std::sqrt(11.0), 1e-15);
  EXPECT_NEAR(terms[2].coefficient, 1 / std::sqrt(11.0), 1e-15);
}

TEST(AbaqusConstraints, EquationsHaveTheirTermsInAxesOfTheMesh) {
  const ImportedMesh mesh = read("constraints.inp");
  ASSERT_EQ(mesh.equations.size(), 6u + 6u + 1u + 2u + 1u + 2u);
  EXPECT_EQ(mesh.equations[13].terms[0].node, 0);  // sets are gone through by number
  const auto& three = mesh.equations[15].terms;
  ASSERT_EQ(three.size(), 3u);
  EXPECT_EQ(three[1].variable, 3);
  EXPECT_EQ(three[1].coefficient, 0.5);
  // Direction 1 of node 7 is y of the mesh; that of node 8, at (1, 0, 1), is radial: x.
  EXPECT_EQ(mesh.equations[16].terms[0].variable, 1);
  EXPECT_EQ(mesh.equations[17].terms[0].variable, 0);
}

TEST(AbaqusConstraints, RigidBodiesTakeElementsAndPinnedNodes) {
  const ImportedMesh mesh = read("constraints.inp");
  ASSERT_EQ(mesh.rigid_links.size(), 1u + 2u + 2u);
  const auto& body = mesh.rigid_links[1];
  EXPECT_THAT(labels(mesh, body.nodes), ElementsAre(1, 2, 3, 5));
  EXPECT_TRUE(body.variables[5]);
  const auto& pinned = mesh.rigid_links[2];
  EXPECT_THAT(labels(mesh, pinned.nodes), ElementsAre(7));
  EXPECT_FALSE(pinned.variables[3]);
  const auto& kinematic = mesh.rigid_links[3];
  EXPECT_THAT(kinematic.variables, ElementsAre(true, true, true, false, false, false));
  EXPECT_TRUE(mesh.rigid_links[4].variables[5]);
}

}  // namespace
}  // namespace buckens::mesh_io
