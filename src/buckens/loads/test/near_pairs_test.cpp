// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/near_pairs.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/spatial/test/marker_path.h"

namespace buckens::loads {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

TEST(NearPairs, AreThoseOfComparingAllBoxes) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> place(-1.0, 1.0), size(0.01, 0.3);
  for (const double flatness : {1.0, 0.01}) {
    std::vector<AlignedBox3d> boxes;
    for (int k = 0; k < 200; ++k) {
      const Vector3d middle(place(engine), flatness * place(engine), place(engine));
      const Vector3d half(size(engine), size(engine), size(engine));
      boxes.emplace_back(middle - half, middle + half);
    }
    for (const int k : {3, 77}) {
      boxes[static_cast<std::size_t>(k)] = {Vector3d::Constant(-HUGE_VAL),
                                            Vector3d::Constant(HUGE_VAL)};
    }
    std::vector<std::pair<int, int>> all, found;
    for (int i = 0; i < 200; ++i) {
      for (int j = i + 1; j < 200; ++j) {
        const auto& one = boxes[static_cast<std::size_t>(i)];
        if (one.intersects(boxes[static_cast<std::size_t>(j)])) all.emplace_back(i, j);
      }
    }
    find_overlapping(boxes, found);
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, all);
    EXPECT_GT(all.size(), 500U);
  }
}

TEST(NearPairs, NothingOverlapsNothing) {
  std::vector<std::pair<int, int>> found;
  find_overlapping({}, found);
  EXPECT_TRUE(found.empty());
}

TEST(NearPairs, ABoxIsAroundItsShape) {
  const spatial::MarkerMotion at = test::MarkerPath::some(1).at(0.3);
  std::mt19937 engine(3);
  std::normal_distribution<double> normal;
  ContactShape shape;
  shape.kind = ContactShape::Kind::capsule;
  shape.radius = 0.2;
  shape.half_length = 0.7;
  shape.axis = Vector3d(1, 2, -1).normalized();
  const AlignedBox3d round = bounding_box(shape, at);
  AlignedBox3d touched;
  for (int k = 0; k < 3000; ++k) {
    const Vector3d out = Vector3d(normal(engine), normal(engine), normal(engine)).normalized();
    for (const double end : {-1.0, 1.0}) {
      const Vector3d point = at.p + at.R * (end * 0.7 * shape.axis) + 0.2 * out;
      EXPECT_TRUE(round.contains(point));
      touched.extend(point);
    }
  }
  // 3000 directions leave a degree or two, 1e-3 of the radius.
  EXPECT_LT((touched.sizes() - round.sizes()).cwiseAbs().maxCoeff(), 2e-3);
  shape.kind = ContactShape::Kind::box;
  shape.half = {0.3, 0.1, 0.5};
  AlignedBox3d corners;
  for (int k = 0; k < 8; ++k) {
    const Vector3d corner((k & 1) != 0 ? 0.3 : -0.3, (k & 2) != 0 ? 0.1 : -0.1,
                          (k & 4) != 0 ? 0.5 : -0.5);
    corners.extend(Vector3d(at.p + at.R * corner));
  }
  EXPECT_LT((corners.min() - bounding_box(shape, at).min()).norm(), 1e-15);
  EXPECT_LT((corners.max() - bounding_box(shape, at).max()).norm(), 1e-15);
}

}  // namespace
}  // namespace buckens::loads
