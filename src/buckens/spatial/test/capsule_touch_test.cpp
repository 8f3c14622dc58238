// SPDX-License-Identifier: Apache-2.0
// Capsules on boxes and cylinders: gaps against brute force, rates against differences.
#include "buckens/spatial/capsule_touch.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/spatial/test/found_rates.h"

namespace buckens::spatial {
namespace {

using Eigen::Vector3d;
using Kind = TouchSurface::Kind;

TouchSurface solid(Kind kind) {
  TouchSurface out;
  out.kind = kind;
  out.axis = Vector3d(0.3, -0.2, 0.9).normalized();
  out.radius = 0.4;
  out.half_length = 0.5;
  out.half = {0.5, 0.4, 0.3};
  return out;
}

TouchSurface pill() {
  TouchSurface out;
  out.kind = Kind::capsule;
  out.axis = Vector3d(0.1, 0.9, -0.3).normalized();
  out.radius = 0.1;
  out.half_length = 0.6;
  return out;
}

TouchFinders finders(Kind kind) {
  TouchFinders out;
  const TouchSurface on = solid(kind), capsule = pill();
  if (kind == Kind::box) return capsule_over_edges(on, capsule);
  out.push_back(capsule_across_cylinder(on, capsule));
  for (const double one : {1.0, -1.0}) {
    for (const double other : {1.0, -1.0}) {
      out.push_back(capsule_over_rim(on, capsule, one, other));
    }
  }
  return out;
}

/// The least distance of the capsule's axis from the solid, at a great number of its points.
double least_distance(const TouchSurface& on, const MarkerMotion& F, const MarkerMotion& M) {
  double least = HUGE_VAL;
  constexpr int kMany = 20000;
  for (int k = 0; k <= kMany; ++k) {
    const Vector3d at = (2.0 * k / kMany - 1.0) * pill().half_length * pill().axis;
    const Vector3d x = F.R.transpose() * (M.p + M.R * at - F.p);
    least = std::min(least, on.look(x, false).distance);
  }
  return least - pill().radius;
}

TEST(CapsuleTouch, TheLeastGapIsThatOfTheAxis) {
  for (const Kind kind : {Kind::box, Kind::cylinder}) {
    const TouchSurface on = solid(kind);
    std::mt19937 chance(3);
    int count = 0;
    for (int k = 0; k < 400; ++k) {
      const test::MarkerPair placed(chance);
      const MarkerMotion F = placed.F.at(0), M = placed.M.at(0);
      const double least = least_distance(on, F, M);
      if (least < -0.05) continue;
      ++count;
      double gap = HUGE_VAL;
      for (const double end : {1.0, -1.0}) {
        const Vector3d x = M.p + M.R * (end * pill().half_length * pill().axis);
        gap = std::min(gap, on.look(F.R.transpose() * (x - F.p)).distance - pill().radius);
      }
      for (const auto& finder : finders(kind)) {
        TouchPlace place;
        finder->look(F, M, place);
        // Each place belongs to both bodies, so none is nearer than the nearest.
        EXPECT_GE(place.gap, least - 1e-7) << k;
        gap = std::min(gap, place.gap);
      }
      // Points of 6e-5 from each other, at distances of 0.05 and more: (3e-5)²/2/0.05 = 1e-8.
      EXPECT_NEAR(gap, least, 5e-8) << k;
    }
    EXPECT_GT(count, 100);
  }
}

TEST(CapsuleTouch, RatesAreThoseOfGapPlaceAndNormal) {
  for (const Kind kind : {Kind::box, Kind::cylinder}) {
    std::mt19937 chance(4);
    int count = 0;
    for (int k = 0; k < 200; ++k) {
      const test::MarkerPair placed(chance);
      if (least_distance(solid(kind), placed.F.at(0), placed.M.at(0)) < 0.02) continue;
      for (const auto& finder : finders(kind))
        count += test::expect_rates(*finder, placed.F, placed.M);
    }
    EXPECT_GT(count, 200);
  }
}

/// Both bodies where the solid's axes are those of the world.
MarkerMotion at(const Vector3d& p, const Vector3d& turn = Vector3d::Zero()) {
  MarkerMotion out;
  out.p = p;
  out.R = exp_rotation(turn).toRotationMatrix();
  return out;
}

TEST(CapsuleTouch, OneThatLiesAcrossABoxTouchesBothEdges) {
  TouchSurface box = solid(Kind::box), capsule = pill();
  capsule.axis = Vector3d::UnitX();
  capsule.half_length = 2.0;
  const MarkerMotion M = at({0.3, 0.1, 0.4});
  int count = 0;
  for (const auto& finder : capsule_over_edges(box, capsule)) {
    TouchPlace place;
    finder->look(at({0, 0, 0}), M, place);
    if (place.gap > 1e-12) continue;
    ++count;
    EXPECT_NEAR(std::abs(place.place.x()), 0.5, 1e-12);
    EXPECT_NEAR((place.place - Vector3d(place.place.x(), 0.1, 0.3)).norm(), 0, 1e-12);
  }
  EXPECT_EQ(count, 2);
}

TEST(CapsuleTouch, OneThatLiesOnACylinderTouchesItsRim) {
  TouchSurface cylinder = solid(Kind::cylinder), capsule = pill();
  cylinder.axis = Vector3d::UnitZ();
  capsule.axis = Vector3d::UnitX();
  capsule.half_length = 2.0;
  for (const double tilt : {0.0, 1e-15, -1e-15}) {
    // On its end, 0.24 beside the middle: the chord is 0.64 long.
    const MarkerMotion M = at({0.3, 0.24, 0.6}, {0, tilt, 0});
    for (const double towards : {1.0, -1.0}) {
      TouchPlace place;
      capsule_over_rim(cylinder, capsule, 1.0, towards)->look(at({0, 0, 0}), M, place);
      EXPECT_NEAR(place.gap, 0, 1e-12);
      EXPECT_NEAR((place.place - Vector3d(towards * 0.32, 0.24, 0.5)).norm(), 0, 1e-9);
    }
    // Along its side: both rims.
    const MarkerMotion beside = at({0.3, 0.4, 0.2}, {0, 0.5 * M_PI + tilt, 0});
    for (const double end : {1.0, -1.0}) {
      for (const double towards : {1.0, -1.0}) {
        TouchPlace place;
        capsule_over_rim(cylinder, capsule, end, towards)->look(at({0, 0, 0}), beside, place);
        EXPECT_NEAR(place.gap, 0, 1e-12);
        EXPECT_NEAR((place.place - Vector3d(0.24, 0.32, 0.5 * end)).norm(), 0, 1e-9);
      }
    }
  }
}

TEST(CapsuleTouch, OneThatLeansOnARimAcrossTouchesItOnce) {
  TouchSurface cylinder = solid(Kind::cylinder), capsule = pill();
  cylinder.axis = Vector3d::UnitZ();
  capsule.axis = Vector3d::UnitX();
  // Its middle is nearest: 0.06 beyond the rim and 0.08 above.
  for (const double hair : {0.0, 1e-15, -1e-15}) {
    const MarkerMotion M = at({hair, 0.46, 0.58});
    TouchPlace nearest;
    nearest.gap = HUGE_VAL;
    for (const double towards : {1.0, -1.0}) {
      TouchPlace place;
      capsule_over_rim(cylinder, capsule, 1.0, towards)->look(at({0, 0, 0}), M, place);
      if (place.gap < nearest.gap) nearest = place;
    }
    EXPECT_NEAR(nearest.gap, 0, 1e-14);
    EXPECT_NEAR((nearest.place - Vector3d(0, 0.4, 0.5)).norm(), 0, 1e-12);
  }
}

}  // namespace
}  // namespace buckens::spatial
