// SPDX-License-Identifier: Apache-2.0
// Which faces have a wall of one flat element behind them, and which sizes follow from that; which
// elements have no volume.
#include <gtest/gtest.h>

#include "buckens/mesh_io/step/flat_elements.h"
#include "buckens/mesh_io/step/walls.h"

namespace buckens::mesh_io {
namespace {

/// A box with a square base of side 1 as five tetrahedra: four at corners and one in the middle.
/// Face 1 is below, 2 above, 3 in front; the rest has no name.
PartMesh box(double height) {
  PartMesh out;
  for (std::size_t n = 0; n < 8; ++n) {
    out.positions[n + 10] = {static_cast<double>(n % 2), static_cast<double>(n / 2 % 2),
                             n < 4 ? 0.0 : height};
  }
  out.tetrahedra = {11, 10, 13, 15, 12, 10, 13, 16, 14, 15, 16, 10, 17, 15, 16, 13, 10, 13, 15, 16};
  out.faces = {
      {1, {10, 11, 13, 10, 12, 13}}, {2, {14, 15, 16, 15, 16, 17}}, {3, {10, 11, 15, 10, 14, 15}}};
  return out;
}

TEST(StepWalls, flat_elements_tell_the_thickness) {
  const auto flat = flat_faces(box(0.05));
  ASSERT_EQ(flat.size(), 2u) << "not the narrow face in front";
  for (const FlatFace& face : flat) {
    EXPECT_NEAR(face.area, 1.0, 1e-14);
    EXPECT_NEAR(face.wall, 0.05, 1e-15);
  }
  // A triangle of area 1/2 is as large as a regular one with sides of 1.07.
  EXPECT_TRUE(flat_faces(box(1.08 / kFlat)).empty());
  EXPECT_EQ(flat_faces(box(1.06 / kFlat)).size(), 2u);
}

TEST(StepWalls, tips_inside_are_no_wall) {
  PartMesh mesh = box(0.05);
  mesh.faces.erase(mesh.faces.begin() + 1, mesh.faces.end());
  // Tips of the elements on the lower face are now on no face but this.
  EXPECT_TRUE(flat_faces(mesh).empty());
}

TEST(StepWalls, sizes_are_a_number_of_thicknesses_within_bounds) {
  const std::vector<FlatFace> faces = {{1, 1.0, 0.01}, {2, 1.0, 1e-4}, {3, 1.0, 0.11}};
  const auto sizes = sizes_for_walls(faces, 0.02, 1.0, 1e9);
  EXPECT_EQ(sizes.size(), 2u) << "0.88 in place of 1 is not worth another mesh";
  EXPECT_NEAR(sizes.at(1), kFlat * 0.01, 1e-15);
  EXPECT_NEAR(sizes.at(2), 0.02, 1e-15) << "the least";
}

TEST(StepWalls, few_elements_are_spread_over_all_faces) {
  const std::vector<FlatFace> faces = {{1, 1.0, 0.01}, {2, 2.0, 0.005}};
  const auto free = sizes_for_walls(faces, 1e-3, 1.0, 1e9);
  // Triangles of 0.08 and 0.04, one and a half elements on each: 541 and 4330.
  const double elements = 1.5 / 0.433 * (1 / (0.08 * 0.08) + 2 / (0.04 * 0.04));
  const auto bounded = sizes_for_walls(faces, 1e-3, 1.0, elements / 4);
  for (const int face : {1, 2}) EXPECT_NEAR(bounded.at(face), 2 * free.at(face), 1e-12);
}

TEST(StepWalls, elements_without_volume_are_told) {
  EXPECT_TRUE(tetrahedra_without_volume(box(1e-6)).empty());
  EXPECT_EQ(tetrahedra_without_volume(box(1e-13)).size(), 5u);
  PartMesh mesh = box(1);
  mesh.positions[15] = {0.7, 0.2, 0};  // in the plane of one of its elements
  EXPECT_EQ(tetrahedra_without_volume(mesh), (std::vector<std::size_t>{0}));
}

}  // namespace
}  // namespace buckens::mesh_io
