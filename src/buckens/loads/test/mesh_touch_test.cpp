// SPDX-License-Identifier: Apache-2.0
// Places of rigid contact on surfaces of triangles: which corners they are, distances against those
// of the whole surface, rates against differences.
#include "buckens/loads/mesh_touch.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/loads/test/triangle_block.h"
#include "buckens/spatial/test/found_rates.h"

namespace buckens::loads {
namespace {

using Eigen::Vector3d;
using spatial::MarkerMotion;
using spatial::TouchPlace;
using spatial::TriangleList;

TriangleList block(const Vector3d& half, int n) {
  TriangleList out;
  test::add_block(Vector3d::Zero(), half, n, out);
  return out;
}

/// A torus, which bends both ways.
TriangleList ring(int around, int across) {
  TriangleList out;
  const auto at = [&](int i, int j) { return (i % around) * across + j % across; };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double a = 2 * M_PI * i / around, b = 2 * M_PI * j / across;
      const double r = 1.0 + 0.4 * std::cos(b);
      out.points.emplace_back(r * std::cos(a), r * std::sin(a), 0.4 * std::sin(b));
      out.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      out.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return out;
}

TEST(MeshTouch, OnlyCornersOfABlockAreSharp) {
  const Vector3d half(0.2, 0.15, 0.1);
  for (const int n : {1, 5}) {
    const std::vector<Vector3d> corners = ContactMesh(block(half, n), 0.5).sharp_corners();
    EXPECT_EQ(corners.size(), 8u);
    for (const Vector3d& x : corners) EXPECT_NEAR((x.cwiseAbs() - half).norm(), 0, 1e-15);
  }
  // All points of a round surface are.
  EXPECT_EQ(ContactMesh(ring(20, 12), 0.6).sharp_corners().size(), 240u);
}

TEST(MeshTouch, CornersOfAGroupAreFarFromEachOther) {
  const std::vector<Vector3d> corners = ContactMesh(ring(30, 16), 0.6).sharp_corners();
  const auto groups = far_groups(corners, kCornerGroups);
  EXPECT_EQ(groups.size(), 24u);
  std::size_t count = 0;
  // Neighbours are up to 0.29 apart.
  for (const auto& group : groups) {
    count += group.size();
    for (std::size_t i = 0; i < group.size(); ++i) {
      const auto at = [&](std::size_t k) { return corners[static_cast<std::size_t>(group[k])]; };
      for (std::size_t j = 0; j < i; ++j) EXPECT_GT((at(i) - at(j)).norm(), 0.3);
    }
  }
  EXPECT_EQ(count, corners.size());
}

TEST(MeshTouch, TheLowestCornerIsAmongThePlaces) {
  const ContactMesh mesh(ring(20, 12), 0.6);
  spatial::TouchSurface plane;
  plane.axis = Vector3d(0.3, -0.2, 0.9).normalized();
  const auto finders = plane_touches(plane, mesh);
  for (int k = 0; k < 20; ++k) {
    const test::MarkerPath F = test::MarkerPath::some(k), M = test::MarkerPath::some(k + 1);
    const MarkerMotion first = F.at(0), second = M.at(0);
    double least = HUGE_VAL, gap = HUGE_VAL;
    for (const Vector3d& x : mesh.sharp_corners()) {
      const Vector3d there = second.p + second.R * x - first.p;
      least = std::min(least, plane.axis.dot(first.R.transpose() * there));
    }
    for (const auto& finder : finders) {
      TouchPlace place;
      finder->look(first, second, place);
      gap = std::min(gap, place.gap);
      test::expect_rates(*finder, F, M);
    }
    EXPECT_NEAR(gap, least, 1e-13);
  }
}

TEST(MeshTouch, TheNearestPatchIsTheNearestPlace) {
  std::mt19937 chance(5);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto meshes = {std::make_shared<const ContactMesh>(block({0.2, 0.15, 0.1}, 3), 0.5),
                       std::make_shared<const ContactMesh>(ring(40, 24), 0.6)};
  for (const auto& mesh : meshes) {
    int count = 0;
    for (int k = 0; k < 300; ++k) {
      const auto vector = [&] { return Vector3d(any(chance), any(chance), any(chance)); };
      test::MarkerPath F, M;
      for (test::MarkerPath* path : {&F, &M}) {
        *path = {vector(), vector(), vector(), spatial::exp_rotation(vector()).toRotationMatrix(),
                 vector(), vector()};
      }
      const Vector3d at(0.1, -0.05, 0.02);
      const Vector3d point = F.R.transpose() * (M.p + M.R * at - F.p);
      const ContactMesh::Nearest nearest = mesh->nearest(point);
      if (nearest.distance < 0.05) continue;
      double gap = HUGE_VAL;
      for (const auto& finder : sphere_touches(mesh, 0.05, at)) {
        TouchPlace place;
        finder->look(F.at(0), M.at(0), place);
        gap = std::min(gap, place.gap);
        count += test::expect_rates(*finder, F, M);
      }
      EXPECT_NEAR(gap, nearest.distance - 0.05, 1e-14);
    }
    EXPECT_GT(count, 100);
  }
}

}  // namespace
}  // namespace buckens::loads
