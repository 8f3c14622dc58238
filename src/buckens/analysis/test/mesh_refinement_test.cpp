// SPDX-License-Identifier: Apache-2.0
// Finer and coarser meshes of a description, and sensors that keep their places.
#include "buckens/analysis/error/mesh_refinement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/model/test/described.h"

namespace buckens::analysis {
namespace {

using model::test::Described;

int elements_of(const model::ModelDescription& description, std::size_t body) {
  return std::get<fem::BeamSpec>(description.bodies[body].kind).elements;
}

TEST(MeshRefinement, DividesBeamsAndBlocks) {
  Described m;
  m.rigid("hub", 1, {0, 0, 0}, {1, 1, 1});
  m.beam("rod", {0, 0, 0}, {1, 0, 0}, 6);
  m.block("block", {1, 1, 1}, {4, 2, 6});
  const MeshRefinement done = refine_meshes(m.d, MeshChange::finer);
  EXPECT_THAT(done.changed, testing::ElementsAre("rod", "block"));
  EXPECT_TRUE(done.unchanged.empty());
  EXPECT_EQ(done.growth, 8.0);
  EXPECT_EQ(elements_of(m.d, 1), 12);
  const auto& mesh = std::get<fem::MeshSpec>(m.d.bodies[2].kind);
  EXPECT_EQ(std::get<fem::BoxMeshSpec>(mesh.shape).divisions, (std::array<int, 3>{8, 4, 12}));
  EXPECT_TRUE(refine_meshes(m.d, MeshChange::coarser).is_possible);
  EXPECT_EQ(elements_of(m.d, 1), 6);
  EXPECT_TRUE(refine_meshes(m.d, MeshChange::coarser).is_possible);
  EXPECT_FALSE(refine_meshes(m.d, MeshChange::coarser).is_possible);  // 3 elements
}

TEST(MeshRefinement, SensorsAtElementsStayWhereTheyAre) {
  Described m;
  m.beam("rod", {0, 0, 0}, {1, 0, 0}, 4);
  model::StressSensor& sensor = m.sensor<model::StressSensor>("root");
  sensor.of = model::test::at_marker("rod");
  sensor.element = 3;  // begins at half the length
  refine_meshes(m.d, MeshChange::finer);
  const auto& moved = std::get<model::StressSensor>(m.d.output.sensors[0].kind);
  EXPECT_EQ(moved.element, 5);
}

TEST(MeshRefinement, FramesNeedElements) {
  Described m;
  m.beam("rod", {0, 0, 0}, {1, 0, 0}, 4).frames = 2;
  m.beam("stub", {0, 0, 0}, {1, 0, 0}, 3).frames = 2;
  m.beam("reduced", {0, 0, 0}, {1, 0, 0}, 8).reduction.free_free.emplace();
  EXPECT_THAT(refine_frames(m.d), testing::ElementsAre("rod"));
  EXPECT_EQ(m.d.bodies[0].frames.count, 4);
  EXPECT_EQ(m.d.bodies[1].frames.count, 2);
}

}  // namespace
}  // namespace buckens::analysis
