// SPDX-License-Identifier: Apache-2.0
// Places of rigid contact of cylinders and capsules with surfaces of triangles: gaps against those
// of the same box and against all points of an axis, rates against differences.
#include "buckens/loads/cylinder_over_mesh.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/loads/mesh_touch.h"
#include "buckens/loads/test/triangle_ball.h"
#include "buckens/loads/test/triangle_block.h"
#include "buckens/spatial/capsule_touch.h"
#include "buckens/spatial/cylinder_touch.h"
#include "buckens/spatial/test/found_rates.h"

namespace buckens::loads {
namespace {

using Eigen::Vector3d;
using spatial::MarkerMotion;
using spatial::TouchFinders;
using spatial::TouchPlace;
using spatial::TouchSurface;
using spatial::TriangleList;

const Vector3d kHalf(0.3, 0.25, 0.2);

TriangleList block(int n) {
  TriangleList out;
  test::add_block(Vector3d::Zero(), kHalf, n, out);
  return out;
}

TouchSurface box() {
  TouchSurface out;
  out.kind = TouchSurface::Kind::box;
  out.half = kHalf;
  return out;
}

TouchSurface bar(TouchSurface::Kind kind) {
  TouchSurface out;
  out.kind = kind;
  out.axis = Vector3d(0.1, 0.9, -0.3).normalized();
  out.radius = 0.15;
  out.half_length = 0.2;
  return out;
}

TouchPlace nearest_of(const TouchFinders& finders, const MarkerMotion& F, const MarkerMotion& M) {
  TouchPlace out;
  out.gap = HUGE_VAL;
  for (const auto& finder : finders) {
    TouchPlace place;
    finder->look(F, M, place);
    if (place.gap < out.gap) out = place;
  }
  return out;
}

/// By how much a plane across this normal separates the box of F from a cylinder of M: no more than
/// their distance, and that much across the normal of the nearest place.
double separation(const Vector3d& normal, const TouchSurface& drum, const MarkerMotion& F,
                  const MarkerMotion& M) {
  const Vector3d own = M.R.transpose() * normal;
  const double along = drum.axis.dot(own);
  return normal.dot(M.p - F.p) - kHalf.dot((F.R.transpose() * normal).cwiseAbs()) -
         drum.half_length * std::abs(along) - drum.radius * (own - along * drum.axis).norm();
}

TEST(CylinderOverMesh, TheLeastGapIsTheDistanceFromTheBox) {
  const TouchSurface drum = bar(TouchSurface::Kind::cylinder);
  for (const int n : {1, 3}) {
    const TouchFinders finders =
        cylinder_over_mesh(std::make_shared<const Polyhedron>(block(n)), drum);
    std::mt19937 chance(3);
    int count = 0;
    for (int k = 0; k < 2000; ++k) {
      const test::MarkerPair placed(chance, 0.4);
      const MarkerMotion F = placed.F.at(0), M = placed.M.at(0);
      const TouchPlace nearest = nearest_of(finders, F, M);
      double most = separation(nearest.normal, drum, F, M);
      const TouchPlace of_box = nearest_of(spatial::cylinder_over_box(box(), drum), F, M);
      most = std::max(most, separation(of_box.normal, drum, F, M));
      // What is far away has places that are not its nearest.
      if (most < 1e-3 || most > 0.1) continue;
      ++count;
      EXPECT_NEAR(nearest.gap, most, 1e-11) << k;
    }
    EXPECT_GT(count, 200);
  }
}

TEST(CylinderOverMesh, WhatOverlapsSaysByHowMuch) {
  const TouchSurface drum = bar(TouchSurface::Kind::cylinder);
  const TouchFinders as_box = spatial::cylinder_over_box(box(), drum);
  const TouchFinders finders =
      cylinder_over_mesh(std::make_shared<const Polyhedron>(block(2)), drum);
  std::mt19937 chance(5);
  int count = 0, aside = 0;
  for (int k = 0; k < 2000; ++k) {
    const test::MarkerPair placed(chance, 0.4);
    const MarkerMotion F = placed.F.at(0);
    MarkerMotion M = placed.M.at(0);
    TouchPlace nearest = nearest_of(as_box, F, M);
    if (nearest.gap > 0.05 || separation(nearest.normal, drum, F, M) < 1e-3) continue;
    for (int turn = 0; turn < 4; ++turn) {
      M.p -= (nearest.gap - 1e-7) * nearest.normal;
      nearest = nearest_of(as_box, F, M);
    }
    // Not in place yet; and corners at edges, rims and corners have no normal of their own.
    if (std::abs(nearest.gap - 1e-7) > 1e-8 || nearest.normal_rate.norm() > 1e3) continue;
    ++count;
    for (const double depth : {1e-7, 1e-5, 1e-3}) {
      MarkerMotion inside = M;
      inside.p -= (depth + 1e-7) * nearest.normal;
      int touching = 0;
      for (const auto& finder : finders) {
        TouchPlace place;
        finder->look(F, inside, place);
        EXPECT_TRUE(place.touches || place.gap > 0) << k;
        if (place.gap >= 0.0) continue;
        ++touching;
        EXPECT_GT(place.gap, -1.1 * depth) << k;
        const bool is_across = place.normal.dot(nearest.normal) > 0.95;
        // Deep enough, what was beside a corner or an edge may be beyond it.
        if (depth < 1e-4) EXPECT_TRUE(is_across) << k << ' ' << depth;
        aside += is_across ? 0 : 1;
      }
      EXPECT_GE(touching, 1) << k << ' ' << depth;
    }
  }
  EXPECT_GT(count, 60);
  EXPECT_LT(aside, count / 25);
}

/// Whether a finder goes over to another feature or facet nearby, so that differences with two
/// steps do not agree.
bool goes_over(const spatial::TouchFinder& finder, const test::MarkerPair& placed) {
  TouchPlace now;
  finder.look(placed.F.at(0), placed.M.at(0), now);
  const auto change = [&](int k) {
    return [&, k](double t) {
      TouchPlace then;
      finder.look(placed.F.at(t), placed.M.at(t), then);
      if (then.touches != now.touches) return 1.0 / t;
      return k < 3 ? then.place[k] : then.normal[k - 3];
    };
  };
  for (int k = 0; k < 6; ++k) {
    if (std::abs(test::derivative(change(k), 2e-4) - test::derivative(change(k), 1e-4)) > 2e-7) {
      return true;
    }
  }
  return false;
}

void expect_rates_of_all(const TouchFinders& finders, double apart, int at_least) {
  std::mt19937 chance(6);
  int count = 0;
  for (int k = 0; k < 100; ++k) {
    test::MarkerPair placed(chance, 0.4);
    placed.M.p = placed.F.p + apart * (placed.M.p - placed.F.p).normalized();
    for (const auto& finder : finders) {
      TouchPlace place;
      finder->look(placed.F.at(0), placed.M.at(0), place);
      if (!place.touches || place.gap > 0.2 || goes_over(*finder, placed)) continue;
      count += test::expect_rates(*finder, placed.F, placed.M);
    }
  }
  EXPECT_GT(count, at_least);
}

TEST(CylinderOverMesh, PlacesMoveAsTheirRatesSay) {
  const TouchSurface drum = bar(TouchSurface::Kind::cylinder);
  for (const TriangleList& mesh : {block(2), test::triangle_ball(0.25, 12, 8)}) {
    expect_rates_of_all(cylinder_over_mesh(std::make_shared<const Polyhedron>(mesh), drum), 0.42,
                        100);
  }
}

TEST(CapsuleOverMesh, TheLeastGapIsThatOfTheBox) {
  const TouchSurface rod = bar(TouchSurface::Kind::capsule);
  const TouchFinders edges = spatial::capsule_over_edges(box(), rod);
  const TouchFinders finders =
      capsule_touches(std::make_shared<const ContactMesh>(block(2), 0.5), rod);
  std::mt19937 chance(3);
  int count = 0;
  for (int k = 0; k < 2000; ++k) {
    const test::MarkerPair placed(chance, 0.4);
    const MarkerMotion F = placed.F.at(0), M = placed.M.at(0);
    double gap = nearest_of(edges, F, M).gap;
    for (const double end : {1.0, -1.0}) {
      const Vector3d x = M.p + M.R * (end * rod.half_length * rod.axis) - F.p;
      gap = std::min(gap, box().look(F.R.transpose() * x).distance - rod.radius);
    }
    // Deeper, the axis itself is inside.
    if (gap < -0.05 || gap > 0.2) continue;
    ++count;
    EXPECT_NEAR(nearest_of(finders, F, M).gap, gap, 1e-12) << k;
  }
  EXPECT_GT(count, 200);
}

TEST(CapsuleOverMesh, TheLeastGapIsThatOfAllPointsOfTheAxis) {
  const TouchSurface rod = bar(TouchSurface::Kind::capsule);
  const auto mesh = std::make_shared<const ContactMesh>(test::triangle_ball(0.25, 24, 14), 0.6);
  const TouchFinders finders = capsule_touches(mesh, rod);
  std::mt19937 chance(4);
  constexpr int kPoints = 1000;
  int between = 0;
  for (int k = 0; k < 100; ++k) {
    const test::MarkerPair placed(chance, 0.3);
    const MarkerMotion F = placed.F.at(0), M = placed.M.at(0);
    double least = HUGE_VAL;
    int best = 0;
    for (int j = 0; j <= kPoints; ++j) {
      const Vector3d at = (2.0 * j / kPoints - 1.0) * rod.half_length * rod.axis;
      const double distance =
          mesh->nearest(F.R.transpose() * (M.p + M.R * at - F.p)).distance - rod.radius;
      if (distance < least) best = j;
      least = std::min(least, distance);
    }
    if (least < -0.1) continue;
    between += best > 0 && best < kPoints ? 1 : 0;
    // Points are 4e-4 apart, which a radius of 0.25 turns into 1e-7.
    const double gap = nearest_of(finders, F, M).gap;
    EXPECT_NEAR(gap, least, 2e-7) << k;
    EXPECT_LE(gap, least + 1e-12) << k;
  }
  EXPECT_GT(between, 15);
  expect_rates_of_all(finders, 0.45, 30);
}

}  // namespace
}  // namespace buckens::loads
