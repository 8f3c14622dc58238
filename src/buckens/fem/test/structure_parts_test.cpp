// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/assembly/structure_parts.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/fem/assembly/assemble.h"

namespace buckens::fem {
namespace {

using Eigen::Vector3d;

BeamProperties steel_strip() {
  return BeamProperties::of({2e11, 0.3, 8e10, 7800, 0, 0}, Section::rectangle(0.02, 0.01),
                            BeamTheory::euler_bernoulli);
}

/// Beam of n elements along x from the origin, 1 m.
Structure straight(int n) {
  Structure s;
  const int a = add_node(s, "a", Vector3d::Zero());
  const int b = add_node(s, "b", Vector3d::UnitX());
  add_beam(s, a, b, n, steel_strip());
  return s;
}

/// Three arms of n elements from one node.
Structure star(int n) {
  Structure s;
  const int c = add_node(s, "c", Vector3d::Zero());
  for (const Vector3d& tip : {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(-1, -1, 0)}) {
    add_beam(s, c, add_node(s, "", tip), n, steel_strip());
  }
  return s;
}

TEST(StructureParts, StraightBeamsAreDividedByLength) {
  EXPECT_EQ(choose_parts(straight(8), 4), (std::vector<int>{0, 0, 1, 1, 2, 2, 3, 3}));
  EXPECT_EQ(choose_parts(straight(5), 5), (std::vector<int>{0, 1, 2, 3, 4}));
  EXPECT_EQ(choose_parts(straight(3), 1), (std::vector<int>{0, 0, 0}));
  const std::vector<int> uneven = choose_parts(straight(7), 3);
  for (int part = 0; part < 3; ++part) {
    EXPECT_GE(std::count(uneven.begin(), uneven.end(), part), 2);
  }
}

TEST(StructureParts, ElementsInARowOfUnequalLength) {
  // 0.9 m in one element, 0.1 m in four: three parts still have an element each.
  Structure s;
  const int a = add_node(s, "a", Vector3d::Zero());
  const int b = add_node(s, "b", {0.9, 0, 0});
  const int c = add_node(s, "c", {1.0, 0, 0});
  add_beam(s, a, b, 1, steel_strip());
  add_beam(s, b, c, 4, steel_strip());
  const std::vector<int> parts = choose_parts(s, 3);
  EXPECT_TRUE(std::is_sorted(parts.begin(), parts.end()));
  EXPECT_EQ(std::set<int>(parts.begin(), parts.end()).size(), 3U);
}

TEST(StructureParts, BranchedMeshesAreDividedIntoConnectedParts) {
  const Structure s = star(4);
  const StructureParts parts = divide(s, choose_parts(s, 3));
  ASSERT_EQ(parts.parts.size(), 3U);
  for (const Structure& part : parts.parts) {
    EXPECT_NO_THROW(assemble(part));  // refuses pieces
    EXPECT_GE(part.beams.num_elements(), 2);
  }
}

TEST(StructureParts, NothingIsLostOrCountedTwice) {
  Structure s = star(3);
  s.masses.add(0, 5.0, Vector3d(1, 2, 2.5).asDiagonal());
  const FeModel whole = assemble(s);
  const StructureParts parts = divide(s, choose_parts(s, 5));
  double mass = 0;
  Vector3d first = Vector3d::Zero();
  int elements = 0;
  std::size_t copies = 0;
  for (const Structure& part : parts.parts) {
    const FeModel fe = assemble(part);
    mass += fe.shape.mass;
    first += fe.shape.mass * fe.shape.com;
    elements += part.beams.num_elements();
    copies += part.nodes.size();
  }
  EXPECT_NEAR(mass, whole.shape.mass, 1e-12 * mass);
  EXPECT_LT((first / mass - whole.shape.com).norm(), 1e-12);
  EXPECT_EQ(elements, 9);
  std::size_t listed = 0;
  for (std::size_t n = 0; n < parts.nodes.size(); ++n) {
    listed += parts.nodes[n].size();
    for (const PartPlace& copy : parts.nodes[n]) {
      const auto& part = parts.parts[static_cast<std::size_t>(copy.part)];
      EXPECT_EQ(part.nodes[static_cast<std::size_t>(copy.index)].position, s.nodes[n].position);
    }
  }
  EXPECT_EQ(listed, copies);
  for (std::size_t e = 0; e < parts.lines.size(); ++e) {
    const PartPlace& at = parts.lines[e];
    const Structure& part = parts.parts[static_cast<std::size_t>(at.part)];
    const auto ends = part.beams.ends(at.index);
    const auto old = s.beams.ends(static_cast<int>(e));
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_EQ(part.nodes[static_cast<std::size_t>(ends[k])].position,
                s.nodes[static_cast<std::size_t>(old[k])].position);
    }
  }
}

TEST(StructureParts, DividedBarsKeepTheirStraightNodes) {
  Structure s;
  const int a = add_node(s, "a", Vector3d::Zero());
  const int b = add_node(s, "b", Vector3d::UnitX());
  add_bar(s, a, b, 3, {2e11, 0.3, 8e10, 7800, 0, 0}, Section::area(1e-4));
  EXPECT_EQ(s.bars.num_elements(), 3);
  EXPECT_EQ(s.straight_nodes.size(), 2U);
  const StructureParts parts = divide(s, choose_parts(s, 3));
  EXPECT_EQ(parts.nodes[static_cast<std::size_t>(s.straight_nodes[0])].size(), 2U);
  EXPECT_THROW(add_bar(s, a, b, 0, {}, {}), ModelError);
}

TEST(StructureParts, RefusesMoreFramesThanElements) {
  try {
    choose_parts(straight(4), 5);
    FAIL();
  } catch (const ModelError& error) {
    EXPECT_NE(std::string(error.what()).find("5 frames for 4 elements"), std::string::npos);
  }
}

}  // namespace
}  // namespace buckens::fem
