// SPDX-License-Identifier: Apache-2.0
// Cylinders on boxes and cylinders: gaps against projections in turn, rates against differences.
#include "buckens/spatial/cylinder_touch.h"

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

TouchSurface lower(TouchSurface::Kind kind) {
  TouchSurface out;
  out.kind = kind;
  out.axis = Vector3d(0.3, -0.2, 0.9).normalized();
  out.radius = 0.4;
  out.half_length = 0.5;
  out.half = {0.5, 0.4, 0.3};
  return out;
}

TouchSurface tube() {
  TouchSurface out;
  out.kind = TouchSurface::Kind::cylinder;
  out.axis = Vector3d(0.1, 0.9, -0.3).normalized();
  out.radius = 0.3;
  out.half_length = 0.35;
  return out;
}

TouchFinders places_of(const TouchSurface& first, const TouchSurface& second) {
  return first.kind == TouchSurface::Kind::box ? cylinder_over_box(first, second)
                                               : cylinder_over_cylinder(first, second);
}

/// The point of a solid that is nearest to x.
Vector3d projected(const TouchSurface& solid, const MarkerMotion& at, const Vector3d& x) {
  const Vector3d own = at.R.transpose() * (x - at.p);
  if (solid.kind == TouchSurface::Kind::box) {
    return at.p + at.R * Vector3d(own.cwiseMin(solid.half).cwiseMax(-solid.half));
  }
  const double along = solid.axis.dot(own);
  Vector3d beside = own - along * solid.axis;
  beside *= std::min(1.0, solid.radius / std::max(beside.norm(), 1e-300));
  const double kept = std::clamp(along, -solid.half_length, solid.half_length);
  return at.p + at.R * Vector3d(beside + kept * solid.axis);
}

/// The distance of two convex solids, by projections on one and the other in turn (Cheney,
/// Goldstein 1959), which come down to it.
double distance_of(const TouchSurface& first, const MarkerMotion& F, const TouchSurface& second,
                   const MarkerMotion& M) {
  Vector3d y = M.p, x = F.p;
  for (int k = 0; k < 400000; ++k) {
    x = projected(first, F, y);
    const Vector3d next = projected(second, M, x);
    const bool has_come = (next - y).norm() < 1e-12;
    y = next;
    if (has_come) break;
  }
  return (x - y).norm();
}

TEST(CylinderTouch, TheLeastGapIsThatOfTheSolids) {
  for (const auto kind : {TouchSurface::Kind::box, TouchSurface::Kind::cylinder}) {
    const TouchSurface first = lower(kind), second = tube();
    const TouchFinders all = places_of(first, second);
    std::mt19937 chance(3);
    int count = 0;
    for (int k = 0; k < 800; ++k) {
      const test::MarkerPair placed(chance, 0.7);
      const MarkerMotion F = placed.F.at(0), M = placed.M.at(0);
      const double least = distance_of(first, F, second, M);
      double gap = HUGE_VAL;
      for (const auto& finder : all) {
        TouchPlace place;
        finder->look(F, M, place);
        // Each place belongs to both bodies, so none is nearer than the nearest.
        if (least > 1e-3) {
          EXPECT_GE(place.gap, least - 1e-6) << k;
        }
        gap = std::min(gap, place.gap);
      }
      // What is far away has places that are not its nearest.
      if (least < 1e-3 || least > 0.1) continue;
      ++count;
      // Projections come near slowly where surfaces are almost parallel.
      EXPECT_NEAR(gap, least, 1e-6) << k;
    }
    EXPECT_GT(count, 40);
  }
}

/// Moves the second away from the first, or towards it, until the distance is this.
void put_at_distance(const TouchSurface& first, const TouchSurface& second,
                     test::MarkerPair& placed, double aim) {
  for (int k = 0; k < 6; ++k) {
    const MarkerMotion F = placed.F.at(0), M = placed.M.at(0);
    Vector3d y = M.p, x = F.p;
    for (int turn = 0; turn < 2000; ++turn) {
      x = projected(first, F, y);
      y = projected(second, M, x);
    }
    const double now = (y - x).norm();
    placed.M.p += now > 1e-9 ? Vector3d((aim - now) / now * (y - x))
                             : Vector3d(0.2 * (M.p - F.p).normalized());
  }
}

TEST(CylinderTouch, WhatOverlapsALittleHasOnePlaceThatSaysByHowMuch) {
  for (const auto kind : {TouchSurface::Kind::box, TouchSurface::Kind::cylinder}) {
    const TouchSurface first = lower(kind), second = tube();
    const TouchFinders all = places_of(first, second);
    std::mt19937 chance(5);
    int count = 0;
    for (int k = 0; k < 200; ++k) {
      test::MarkerPair placed(chance, 0.7);
      put_at_distance(first, second, placed, 1e-3);
      const MarkerMotion F = placed.F.at(0);
      MarkerMotion M = placed.M.at(0);
      TouchPlace nearest;
      for (int turn = 0; turn < 4; ++turn) {
        nearest.gap = HUGE_VAL;
        for (const auto& finder : all) {
          TouchPlace place;
          finder->look(F, M, place);
          if (place.gap < nearest.gap) nearest = place;
        }
        M.p -= (nearest.gap - 1e-7) * nearest.normal;
      }
      if (std::abs(nearest.gap - 1e-7) > 1e-8) continue;  // not in place yet
      // Corners at edges, rims and corners have no normal of their own.
      if (nearest.normal_rate.norm() > 1e3) continue;
      ++count;
      M.p -= 2e-7 * nearest.normal;
      int touching = 0;
      for (const auto& finder : all) {
        TouchPlace place;
        finder->look(F, M, place);
        if (place.gap >= 0.0) continue;
        ++touching;
        EXPECT_GT(place.gap, -1.1e-7) << k;
        EXPECT_GT(place.normal.dot(nearest.normal), 0.99) << k;
      }
      EXPECT_GE(touching, 1) << k;
    }
    EXPECT_GT(count, 100);
  }
}

/// Whether the rates of a place are those of points that are nearest: with the lowest point of a
/// rim beside a face they are not.
bool has_exact_rates(const TouchPlace& place, const TouchSurface& first, const MarkerMotion& F,
                     const TouchSurface& second, const MarkerMotion& M) {
  const double apart = (projected(first, F, place.place) - place.place).norm() +
                       (projected(second, M, place.place) - place.place).norm();
  return std::abs(apart - std::abs(place.gap)) < 1e-9;
}

TEST(CylinderTouch, RatesAreThoseOfGapPlaceAndNormal) {
  for (const auto kind : {TouchSurface::Kind::box, TouchSurface::Kind::cylinder}) {
    const TouchSurface first = lower(kind), second = tube();
    const TouchFinders all = places_of(first, second);
    std::mt19937 chance(4);
    int count = 0;
    for (int k = 0; k < 300; ++k) {
      test::MarkerPair placed(chance, 0.7);
      put_at_distance(first, second, placed, 0.02);
      const MarkerMotion F = placed.F.at(0), M = placed.M.at(0);
      for (const auto& finder : all) {
        TouchPlace place;
        finder->look(F, M, place);
        if (place.gap > 0.1 || !has_exact_rates(place, first, F, second, M)) continue;
        count += test::expect_rates(*finder, placed.F, placed.M);
      }
    }
    EXPECT_GT(count, 300);
  }
}

}  // namespace
}  // namespace buckens::spatial
