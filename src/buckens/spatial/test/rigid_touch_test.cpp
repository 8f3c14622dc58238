// SPDX-License-Identifier: Apache-2.0
// Places of rigid contact against brute force and by hand; their rates:
// joints/test/contact_way_test.
#include "buckens/spatial/rigid_touch.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/spatial/box_touch.h"
#include "buckens/spatial/rotation.h"

namespace buckens::spatial {
namespace {

using Eigen::Matrix3d;
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

/// Places of two boxes on each other, those at the same place once.
std::vector<Vector3d> places(const Vector3d& under, const Vector3d& over, const Vector3d& shift,
                             const Matrix3d& R, double* gap = nullptr) {
  TouchSurface first = surface(Kind::box), second = first;
  first.half = under;
  second.half = over;
  MarkerMotion F, M;
  F.R = exp_rotation({0.3, -0.4, 0.5}).toRotationMatrix();
  M.p = F.R * shift;
  M.R = F.R * R;
  std::vector<Vector3d> out;
  for (int k = 0; k < kBoxDirections; ++k) {
    TouchPlace place;
    look_at_boxes(first, second, k, F, M, place);
    if (gap == nullptr) {
      EXPECT_NEAR(place.gap, 0, 1e-14);
      EXPECT_NEAR((F.R.transpose() * place.normal - Vector3d::UnitZ()).norm(), 0, 1e-14);
    } else {
      *gap = std::min(*gap, place.gap);
    }
    const Vector3d at = F.R.transpose() * place.place;
    const auto is_same = [&](const Vector3d& x) { return (x - at).norm() < 1e-12; };
    if (std::none_of(out.begin(), out.end(), is_same)) out.push_back(at);
  }
  return out;
}

void expect_rectangle(const std::vector<Vector3d>& found, double from_x, double to_x, double from_y,
                      double to_y) {
  EXPECT_EQ(found.size(), 4u);
  for (const double x : {from_x, to_x}) {
    for (const double y : {from_y, to_y}) {
      const bool is_there = std::any_of(found.begin(), found.end(), [&](const Vector3d& at) {
        return (at - Vector3d(x, y, 0.2)).norm() < 1e-12;
      });
      EXPECT_TRUE(is_there) << x << " " << y;
    }
  }
}

TEST(BoxTouch, BoxesTouchInAllCornersOfTheirArea) {
  const Matrix3d even = Matrix3d::Identity();
  const Vector3d half(0.3, 0.4, 0.2);
  // In line, a small one on a large one and the other way round, shifted, crosswise.
  expect_rectangle(places(half, half, {0, 0, 0.4}, even), -0.3, 0.3, -0.4, 0.4);
  expect_rectangle(places(half, {0.1, 0.05, 0.2}, {0.1, 0.1, 0.4}, even), 0, 0.2, 0.05, 0.15);
  expect_rectangle(places({0.1, 0.05, 0.2}, half, {0.1, 0.1, 0.4}, even), -0.1, 0.1, -0.05, 0.05);
  expect_rectangle(places(half, half, {0.4, 0, 0.4}, even), 0.1, 0.3, -0.4, 0.4);
  const Matrix3d quarter = exp_rotation({0, 0, 0.5 * M_PI}).toRotationMatrix();
  expect_rectangle(places({0.5, 0.1, 0.2}, {0.5, 0.1, 0.2}, {0.1, 0, 0.4}, quarter), 0, 0.2, -0.1,
                   0.1);
}

TEST(BoxTouch, SquaresAskewTouchInAnOctagon) {
  const Matrix3d eighth = exp_rotation({0, 0, 0.25 * M_PI}).toRotationMatrix();
  const std::vector<Vector3d> found = places({0.3, 0.3, 0.2}, {0.3, 0.3, 0.2}, {0, 0, 0.4}, eighth);
  EXPECT_EQ(found.size(), 8u);
  for (const Vector3d& at : found) {
    EXPECT_NEAR(std::max(std::abs(at.x()), std::abs(at.y())), 0.3, 1e-12);
    EXPECT_NEAR(std::abs(at.x()) + std::abs(at.y()), 0.3 * M_SQRT2, 1e-12);
  }
}

TEST(BoxTouch, EdgesThatCrossTouchInOnePlace) {
  // Both on their edges, one along y, the other along x; apart by 0.01.
  const double reach = 0.2 * M_SQRT2;
  TouchSurface one = surface(Kind::box);
  one.half = {0.2, 0.5, 0.2};
  TouchSurface other = one;
  other.half = {0.5, 0.2, 0.2};
  MarkerMotion F, M;
  F.R = exp_rotation({0, 0.25 * M_PI, 0}).toRotationMatrix();
  M.R = exp_rotation({0.25 * M_PI, 0, 0}).toRotationMatrix();
  M.p = {0.1, -0.2, 2 * reach + 0.01};
  for (int k = 0; k < kBoxDirections; ++k) {
    TouchPlace place;
    look_at_boxes(one, other, k, F, M, place);
    EXPECT_NEAR(place.gap, 0.01, 1e-14);
    EXPECT_NEAR((place.normal - Vector3d::UnitZ()).norm(), 0, 1e-14);
    EXPECT_NEAR((place.place - Vector3d(0, -0.2, reach + 0.005)).norm(), 0, 1e-14);
  }
}

TEST(BoxTouch, ABoxOnItsCornerTouchesWithIt) {
  double gap = HUGE_VAL;
  const Matrix3d R = exp_rotation({0.6, -0.5, 0.2}).toRotationMatrix();
  double lowest = HUGE_VAL;
  for (const double x : {-0.1, 0.1}) {
    for (const double y : {-0.1, 0.1}) {
      for (const double z : {-0.1, 0.1}) lowest = std::min(lowest, (R * Vector3d(x, y, z)).z());
    }
  }
  places({2, 2, 0.2}, {0.1, 0.1, 0.1}, {0.1, 0.2, 0.2 - lowest + 0.03}, R, &gap);
  EXPECT_NEAR(gap, 0.03, 1e-14);
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
