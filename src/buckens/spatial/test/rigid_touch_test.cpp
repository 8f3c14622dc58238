// SPDX-License-Identifier: Apache-2.0
// Places of rigid contact against brute force and by hand; their rates:
// joints/test/contact_way_test.
#include "buckens/spatial/rigid_touch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/spatial/rotation.h"

namespace buckens::spatial {
namespace {

using Eigen::Vector3d;
using Kind = TouchSurface::Kind;

TouchSurface surface(Kind kind) {
  TouchSurface out;
  out.kind = kind;
  out.radius = 0.3;
  out.half_length = 0.4;
  out.half = {0.3, 0.4, 0.2};
  return out;
}

/// Points of the solid in a grid, those of its surface among them.
std::vector<Vector3d> points_of(const TouchSurface& shape) {
  std::vector<Vector3d> out;
  constexpr int kEach = 24;
  for (int i = 0; i <= kEach; ++i) {
    for (int j = 0; j <= kEach; ++j) {
      for (int k = 0; k <= kEach; ++k) {
        const Vector3d share = Vector3d(i, j, k) * (2.0 / kEach) - Vector3d::Ones();
        if (shape.kind == Kind::box) {
          out.push_back(share.cwiseProduct(shape.half));
          continue;
        }
        // Turns around z, ways along it, and for capsules heights of the round ends.
        const double turn = M_PI * share.x();
        const Vector3d radial(std::cos(turn), std::sin(turn), 0.0);
        if (shape.kind == Kind::cylinder) {
          out.emplace_back(0.5 * (1.0 + share.y()) * shape.radius * radial +
                           share.z() * shape.half_length * Vector3d::UnitZ());
        } else {
          const double rise = 0.5 * M_PI * share.y();
          out.emplace_back(shape.radius *
                               (std::cos(rise) * radial + std::sin(rise) * Vector3d::UnitZ()) +
                           share.z() * shape.half_length * Vector3d::UnitZ());
        }
      }
    }
  }
  return out;
}

TEST(TouchSurface, DistancesAreTheSmallest) {
  for (const Kind kind : {Kind::capsule, Kind::cylinder, Kind::box}) {
    const TouchSurface shape = surface(kind);
    const std::vector<Vector3d> solid = points_of(shape);
    for (const Vector3d& point : {Vector3d(0.7, -0.5, 0.1), Vector3d(0.1, 0.2, -0.9),
                                  Vector3d(-0.5, 0.6, 0.8), Vector3d(0.5, 0.1, 0.0)}) {
      const TouchSurface::View view = shape.look(point);
      double least = HUGE_VAL;
      for (const Vector3d& x : solid) least = std::min(least, (x - point).norm());
      EXPECT_LE(view.distance, least + 1e-12);
      EXPECT_GE(view.distance, least - 0.01);  // a twelfth of 0.4, seen from 0.2 and more
      EXPECT_NEAR(view.normal.norm(), 1, 1e-14);
      EXPECT_NEAR(shape.look(point - view.distance * view.normal).distance, 0, 1e-14);
    }
  }
}

TEST(RigidTouch, TheLowestPointOfARimIsBelowAllOthers) {
  RigidTouch::Data data;
  data.feature = RigidTouch::Feature::rim;
  data.radius = 0.3;
  data.at = {0, 0, 0.4};
  MarkerMotion F, M;
  F.R = exp_rotation({0.3, -0.4, 0.5}).toRotationMatrix();
  M.R = exp_rotation({-0.8, 0.3, 0.9}).toRotationMatrix();
  M.p = {0.2, 0.5, -0.1};
  const TouchPlace place = RigidTouch(data).look(F, M);
  double least = HUGE_VAL;
  for (int k = 0; k < 3600; ++k) {
    const double turn = M_PI / 1800 * k;
    const Vector3d x = M.p + M.R * Vector3d(0.3 * std::cos(turn), 0.3 * std::sin(turn), 0.4);
    least = std::min(least, place.normal.dot(x));
  }
  EXPECT_LE(place.gap, least + 1e-14);
  EXPECT_NEAR(place.gap, least, 1e-6);  // 0.3 (1 - cos of half a tenth of a degree) = 1e-7
}

/// Counts how often it is asked.
struct CountingFinder final : TouchFinder {
  void look(const MarkerMotion& F, const MarkerMotion& M, TouchPlace& out) const override {
    ++num_looks;
    out.place = M.p;
    out.normal = (M.p - F.p).normalized();
    out.gap = (M.p - F.p).norm();
    out.place_rate = M.v;
    out.normal_rate.setZero();
  }
  mutable int num_looks = 0;
};

TEST(RigidTouch, LooksOnceForTheSameMotions) {
  const auto finder = std::make_shared<CountingFinder>();
  RigidTouch::Data data;
  data.feature = RigidTouch::Feature::found;
  data.finder = finder;
  const RigidTouch touch(data);
  const RigidTouch copy = touch, other(data);
  MarkerMotion F, M;
  M.p = {0, 0, 2};
  EXPECT_EQ(touch.look(F, M).gap, 2);
  EXPECT_EQ(copy.look(F, M).gap, 2);
  EXPECT_EQ(finder->num_looks, 1);
  EXPECT_EQ(other.look(F, M).gap, 2);
  EXPECT_EQ(finder->num_looks, 2);
  // Anything that moves is looked at anew, and what was before it as well.
  M.v = {0, 0, 1};
  EXPECT_EQ(touch.look(F, M).place_rate.z(), 1);
  M.p = {0, 0, 3};
  EXPECT_EQ(touch.look(F, M).gap, 3);
  F.w = {1, 0, 0};
  touch.look(F, M);
  F.R = exp_rotation({0.3, 0, 0}).toRotationMatrix();
  touch.look(F, M);
  EXPECT_EQ(finder->num_looks, 6);
  // Another thread looks for itself.
  std::thread([&] { touch.look(F, M); }).join();
  EXPECT_EQ(finder->num_looks, 7);
}

}  // namespace
}  // namespace buckens::spatial
