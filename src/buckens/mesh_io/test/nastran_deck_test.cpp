// SPDX-License-Identifier: Apache-2.0
// The deck with every supported card, in the three field formats.
#include <cmath>
#include <filesystem>
#include <numbers>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/test/source_directory.h"
#include "buckens/fem/solid/shape.h"
#include "buckens/mesh_io/nastran/deck.h"
#include "buckens/mesh_io/test/nastran_sample.h"

namespace buckens::mesh_io {
namespace {

using Eigen::Vector3d;
using fem::CellKind;
using test::has_note;
using testing::ElementsAre;

constexpr double kRounding = 1e-12;  // a few operations on numbers of size one

std::filesystem::path deck(const std::string& name) {
  return std::filesystem::path(buckens::test::kSourceDirectory) / "tests/decks/nastran" / name;
}

const fem::ImportedMesh& every_card() {
  static const fem::ImportedMesh mesh = read_nastran_deck(deck("every_card_small.bdf"));
  return mesh;
}

/// Block, and place in it, of an element by its number.
std::pair<const fem::ImportedBlock*, std::size_t> find_element(std::int64_t id) {
  for (const fem::ImportedBlock& block : every_card().blocks) {
    for (std::size_t i = 0; i < block.ids.size(); ++i) {
      if (block.ids[i] == id) return {&block, i};
    }
  }
  ADD_FAILURE() << "no element " << id;
  return {&every_card().blocks[0], 0};
}

std::vector<int> nodes_of(std::int64_t id) {
  const auto [block, i] = find_element(id);
  const auto count = static_cast<std::size_t>(fem::num_nodes(block->kind));
  const auto begin = block->nodes.begin() + static_cast<std::ptrdiff_t>(i * count);
  return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

const fem::ImportedProperty& property_of(std::int64_t id) {
  return every_card().properties[static_cast<std::size_t>(find_element(id).first->property)];
}

Vector3d node(std::int64_t id) {
  const fem::ImportedMesh& mesh = every_card();
  for (std::size_t i = 0; i < mesh.node_ids.size(); ++i) {
    if (mesh.node_ids[i] == id) return mesh.positions[i];
  }
  ADD_FAILURE() << "no node " << id;
  return Vector3d::Zero();
}

int node_index(std::int64_t id) {
  const auto& ids = every_card().node_ids;
  return static_cast<int>(std::find(ids.begin(), ids.end(), id) - ids.begin());
}

const fem::MaterialSpec& material(const std::string& name) {
  for (const fem::MaterialSpec& spec : every_card().materials) {
    if (spec.name == name) return spec;
  }
  ADD_FAILURE() << "no material " << name;
  return every_card().materials[0];
}

TEST(NastranDeck, the_three_field_formats_give_the_same_mesh) {
  const fem::ImportedMesh& small = every_card();
  for (const char* format : {"large", "free"}) {
    SCOPED_TRACE(format);
    const fem::ImportedMesh other =
        read_nastran_deck(deck(std::string("every_card_") + format + ".bdf"));
    EXPECT_EQ(small.node_ids, other.node_ids);
    EXPECT_EQ(small.positions, other.positions);
    ASSERT_EQ(small.blocks.size(), other.blocks.size());
    for (std::size_t i = 0; i < small.blocks.size(); ++i) {
      EXPECT_EQ(small.blocks[i].kind, other.blocks[i].kind);
      EXPECT_EQ(small.blocks[i].property, other.blocks[i].property);
      EXPECT_EQ(small.blocks[i].ids, other.blocks[i].ids);
      EXPECT_EQ(small.blocks[i].nodes, other.blocks[i].nodes);
      EXPECT_EQ(small.blocks[i].up, other.blocks[i].up);
    }
    ASSERT_EQ(small.properties.size(), other.properties.size());
    ASSERT_EQ(small.materials.size(), other.materials.size());
    EXPECT_EQ(small.masses.at(0).inertia, other.masses.at(0).inertia);
    EXPECT_EQ(small.springs.at(0).stiffness, other.springs.at(0).stiffness);
    EXPECT_EQ(small.rigid_links.size(), other.rigid_links.size());
    EXPECT_EQ(small.averages.at(0).nodes, other.averages.at(0).nodes);
    EXPECT_EQ(small.equations.size(), other.equations.size());
    EXPECT_EQ(small.node_sets.size(), other.node_sets.size());
    EXPECT_EQ(small.notes.size(), other.notes.size());
  }
}

TEST(NastranDeck, coordinate_systems_are_followed) {
  // System 1: origin (100, 0, 0), x along y, y along −x.
  EXPECT_LT((node(201) - Vector3d(100, 10, 5)).norm(), 100 * kRounding);
  EXPECT_LT((node(202) - Vector3d(90, 0, 5)).norm(), 100 * kRounding);
  EXPECT_LT((node(203) - Vector3d(0, 20, 0)).norm(), 100 * kRounding);
}

TEST(NastranDeck, mid_side_nodes_lie_between_their_corners) {
  const auto expect_mid = [](std::int64_t id, const std::vector<std::array<int, 2>>& edges) {
    const std::vector<int> nodes = nodes_of(id);
    const auto place = [&](std::size_t i) {
      return every_card().positions[static_cast<std::size_t>(nodes[i])];
    };
    const std::size_t corners = nodes.size() - edges.size();
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const Vector3d mean = 0.5 * (place(static_cast<std::size_t>(edges[e][0])) +
                                   place(static_cast<std::size_t>(edges[e][1])));
      EXPECT_LT((place(corners + e) - mean).norm(), kRounding)
          << "element " << id << ", edge " << e;
    }
  };
  expect_mid(2, fem::solid_topology(fem::SolidKind::hex20).edges);
  expect_mid(6, fem::solid_topology(fem::SolidKind::tet10).edges);
  // C3D15: edges of the lower triangle, of the upper, then upright.
  expect_mid(4, {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}});
}

TEST(NastranDeck, elements_have_their_kinds) {
  const std::vector<std::pair<std::int64_t, CellKind>> kinds = {
      {1, CellKind::hex8},   {2, CellKind::hex20},  {3, CellKind::wedge6},   {4, CellKind::wedge15},
      {5, CellKind::tet4},   {6, CellKind::tet10},  {7, CellKind::pyramid5}, {11, CellKind::quad4},
      {12, CellKind::tri3},  {13, CellKind::tri3},  {14, CellKind::quad4},   {21, CellKind::line2},
      {24, CellKind::line2}, {25, CellKind::line2}, {26, CellKind::line2}};
  for (const auto& [id, kind] : kinds) EXPECT_EQ(find_element(id).first->kind, kind) << id;
  EXPECT_TRUE(has_note(every_card(), "CTRIAR: taken as CTRIA3"));
}

TEST(NastranDeck, solids_have_materials_and_axes) {
  EXPECT_EQ(property_of(1).name, "block");
  EXPECT_EQ(property_of(1).material, "steel");
  EXPECT_EQ(material("steel").E, 2.1e5);
  EXPECT_EQ(material("steel").rho, 7.85e-9);
  const fem::ImportedProperty& turned = property_of(6);
  EXPECT_EQ(turned.material, "MAT9 3");
  ASSERT_TRUE(turned.axes.has_value());
  EXPECT_LT((turned.axes->col(0) - Vector3d::UnitY()).norm(), kRounding);
  const fem::MaterialSpec& nine = material("MAT9 3");
  ASSERT_TRUE(nine.orthotropic.has_value());
  // λ = 1.2e5, μ = 0.8e5: ν = λ/(2(λ + μ)) = 0.3, E = 2μ(1 + ν).
  EXPECT_NEAR(nine.orthotropic->E1, 2.08e5, 2.08e5 * kRounding);
  EXPECT_NEAR(nine.orthotropic->nu23, 0.3, kRounding);
  EXPECT_EQ(nine.orthotropic->G13, 8e4);
}

TEST(NastranDeck, shells_have_thickness_offset_layers) {
  EXPECT_EQ(property_of(11).name, "skin");
  EXPECT_EQ(property_of(11).thickness.value_or(0), 1.5);
  EXPECT_EQ(property_of(11).offset, 0.0);
  EXPECT_EQ(property_of(14).name, "skin");
  EXPECT_EQ(property_of(14).offset, -0.5);
  const fem::ImportedProperty& laminate = property_of(12);
  ASSERT_EQ(laminate.layers.size(), 4u);
  EXPECT_EQ(laminate.layers[1].angle, std::numbers::pi / 2);
  EXPECT_EQ(laminate.layers[2].angle, std::numbers::pi / 2);
  EXPECT_EQ(laminate.layers[3].angle, 0.0);
  EXPECT_EQ(laminate.layers[3].material, "MAT8 2");
  EXPECT_EQ(laminate.offset, 0.5);
  // THETA of 30 degrees from the first side: a layer of the whole thickness.
  EXPECT_FALSE(property_of(13).axes.has_value());
  EXPECT_TRUE(property_of(13).along_first_side);
  ASSERT_EQ(property_of(13).layers.size(), 1u);
  EXPECT_EQ(property_of(13).layers[0].thickness, 2.0);
  EXPECT_NEAR(property_of(13).layers[0].angle, std::numbers::pi / 6, kRounding);
}

TEST(NastranDeck, beams_have_sections_and_directions) {
  const auto general = std::get<fem::GeneralSectionSpec>(property_of(21).section->shape);
  // I1 = 800, I2 = 900, I12 = 100: principal moments 850 ± √(50² + 100²).
  const double radius = std::hypot(50.0, 100.0);
  EXPECT_NEAR(general.Iz, 850 + radius, 850 * kRounding);
  EXPECT_NEAR(general.Iy, 850 - radius, 850 * kRounding);
  EXPECT_EQ(property_of(21).shear_flexible, true);
  // y turns by half the angle of (−50, 100); z follows. Unturned: x = X, y = Z, z = −Y.
  const double angle = 0.5 * std::atan2(100.0, -50.0);
  const auto [block, i] = find_element(21);
  const Vector3d up(0, -std::cos(angle), -std::sin(angle));
  EXPECT_LT((block->up[i].normalized() - up).norm(), kRounding);
  const auto tube = std::get<fem::TubeSpec>(property_of(22).section->shape);
  EXPECT_EQ(tube.outer_diameter, 20.0);
  EXPECT_EQ(tube.inner(), 16.0);
  const auto mean = std::get<fem::GeneralSectionSpec>(property_of(23).section->shape);
  EXPECT_EQ(mean.A, 75.0);
  EXPECT_EQ(mean.Iz, 600.0);
  EXPECT_TRUE(has_note(every_card(), "tapered"));
  // DIM1 = 4 along z, DIM2 = 8 along y.
  const auto bar = std::get<fem::RectangleSpec>(property_of(24).section->shape);
  EXPECT_EQ(bar.width, 8.0);
  EXPECT_EQ(bar.height, 4.0);
  EXPECT_EQ(property_of(25).kind, fem::PropertyKind::bar);
  EXPECT_EQ(property_of(26).name, "CONROD 26");
}

TEST(NastranDeck, offsets_of_beams_become_rigid_links) {
  const std::vector<int> ends = nodes_of(23);
  const auto& positions = every_card().positions;
  EXPECT_EQ(positions[static_cast<std::size_t>(ends[0])], Vector3d(2, 60, 0));
  EXPECT_EQ(positions[static_cast<std::size_t>(ends[1])], Vector3d(2, 60, 50));
  int found = 0;
  for (const fem::ImportedRigidLink& link : every_card().rigid_links) {
    for (const int end : ends) {
      if (link.nodes == std::vector<int>{end}) ++found;
    }
  }
  EXPECT_EQ(found, 2);
}

TEST(NastranDeck, masses_and_springs) {
  const fem::ImportedMass& mass = every_card().masses.at(0);
  EXPECT_EQ(mass.node, node_index(231));
  EXPECT_EQ(mass.mass, 0.002);
  EXPECT_EQ(mass.offset, Vector3d(1, 2, 3));
  EXPECT_EQ(mass.inertia(0, 1), -0.1);
  EXPECT_EQ(mass.inertia(2, 2), 6.0);
  const fem::ImportedSpring& spring = every_card().springs.at(0);
  EXPECT_EQ(spring.stiffness(1, 1), 2000.0);
  EXPECT_EQ(spring.stiffness(5, 5), 6e5);
  // It acts across the line of its nodes: both ends are places half way.
  EXPECT_EQ(every_card().positions[static_cast<std::size_t>(spring.nodes[0])], Vector3d(5, 5, 35));
  EXPECT_EQ(every_card().positions[static_cast<std::size_t>(spring.nodes[1])], Vector3d(5, 5, 35));
  EXPECT_NE(spring.nodes[0], spring.nodes[1]);
}

TEST(NastranDeck, links_means_and_equations) {
  const auto& links = every_card().rigid_links;
  const auto rbe2 = std::find_if(links.begin(), links.end(),
                                 [](const auto& link) { return link.name == "RBE2 51"; });
  ASSERT_NE(rbe2, links.end());
  EXPECT_EQ(rbe2->nodes.size(), 4u);
  EXPECT_EQ(rbe2->reference, node_index(231));
  const auto rbar = std::find_if(links.begin(), links.end(),
                                 [](const auto& link) { return link.name == "RBAR 53"; });
  ASSERT_NE(rbar, links.end());
  EXPECT_EQ(rbar->variables, (std::array<bool, 6>{true, true, true, false, false, false}));
  const fem::ImportedAverage& mean = every_card().averages.at(0);
  EXPECT_EQ(mean.reference, node_index(232));
  EXPECT_EQ(mean.weights, (std::vector<double>{1, 1, 1, 1}));
  // MPC = 30 of the case control; 31 is left out.
  ASSERT_EQ(every_card().equations.size(), 1u);
  EXPECT_EQ(every_card().equations[0].terms.size(), 3u);
  EXPECT_EQ(every_card().equations[0].terms[1].coefficient, -1.0);
}

TEST(NastranDeck, sets_and_notes) {
  const fem::ImportedMesh& mesh = every_card();
  std::vector<std::string> nodes, elements;
  for (const auto& set : mesh.node_sets) nodes.push_back(set.name);
  for (const auto& set : mesh.element_sets) elements.push_back(set.name);
  EXPECT_THAT(nodes, ElementsAre("SET 9", "SET1 1", "SET3 3"));
  EXPECT_THAT(elements, testing::IsSupersetOf({"SET 9", "SET1 1", "SET3 2", "SET3 4", "block"}));
  std::vector<std::int64_t> ids;
  for (const int node : mesh.node_sets[0].nodes) {
    ids.push_back(mesh.node_ids[static_cast<std::size_t>(node)]);
  }
  EXPECT_THAT(ids, ElementsAre(1, 3, 4, 6, 7, 8, 21));
  const auto spc = std::find_if(mesh.notes.begin(), mesh.notes.end(),
                                [](const auto& note) { return note.text.starts_with("SPC1"); });
  ASSERT_NE(spc, mesh.notes.end());
  EXPECT_EQ(spc->count, 2);
}

}  // namespace
}  // namespace buckens::mesh_io
