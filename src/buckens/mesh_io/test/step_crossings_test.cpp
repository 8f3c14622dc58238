// SPDX-License-Identifier: Apache-2.0
// Which triangles of a surface cut each other.
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "buckens/mesh_io/step/crossings.h"

namespace buckens::mesh_io {
namespace {

using Eigen::Vector3d;

/// One triangle in the plane z = 0 on face 1 and another on face 2.
PartMesh two_triangles(const std::vector<Vector3d>& more, std::vector<std::size_t> second) {
  PartMesh out;
  out.positions = {{1, {0, 0, 0}}, {2, {2, 0, 0}}, {3, {0, 2, 0}}};
  for (std::size_t k = 0; k < more.size(); ++k) out.positions[4 + k] = more[k];
  out.faces = {{1, {1, 2, 3}}, {2, std::move(second)}};
  return out;
}

TEST(StepCrossings, a_triangle_through_another_is_found) {
  const auto at_height = [](double x, double z) {
    return surface_crossings(
        two_triangles({{x, 0.25, z - 1}, {x, 0.25, z + 1}, {x + 0.1, 0.3, z + 2}}, {4, 5, 6}));
  };
  const auto through = at_height(0.5, 0);
  ASSERT_EQ(through.size(), 1u);
  EXPECT_NEAR((through[0].place - Vector3d(0.5, 0.25, 0)).norm(), 0.0, 1e-15);
  EXPECT_EQ(through[0].faces, (std::array<int, 2>{1, 2}));
  EXPECT_TRUE(at_height(0.5, 1.01).empty()) << "above";
  EXPECT_TRUE(at_height(0.5, -2.01).empty()) << "below";
  EXPECT_TRUE(at_height(1.76, 0).empty()) << "beside";
}

TEST(StepCrossings, triangles_may_share_a_node) {
  const Vector3d above(0.5, 0.5, 1);
  EXPECT_TRUE(surface_crossings(two_triangles({above, {-1, -1, 1}}, {1, 4, 5})).empty());
  EXPECT_TRUE(surface_crossings(two_triangles({above, {-1, -1, -1}}, {1, 4, 5})).empty());
  EXPECT_EQ(surface_crossings(two_triangles({above, {1, 0.75, -1}}, {1, 4, 5})).size(), 1u);
}

TEST(StepCrossings, triangles_at_an_edge_may_lie_on_each_other) {
  const auto count = [](double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    const Vector3d tip(0.5, std::cos(angle), std::sin(angle));
    return surface_crossings(two_triangles({tip}, {2, 1, 4})).size();
  };
  EXPECT_EQ(count(0.0), 1u);
  EXPECT_EQ(count(0.05), 1u);
  EXPECT_EQ(count(0.2), 0u);
  EXPECT_EQ(count(90), 0u);
  EXPECT_EQ(count(180), 0u) << "side by side";
  EXPECT_EQ(surface_crossings(two_triangles({}, {3, 2, 1})).size(), 1u) << "the same twice";
}

}  // namespace
}  // namespace buckens::mesh_io
