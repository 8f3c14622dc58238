// SPDX-License-Identifier: Apache-2.0
// Places of rigid contact between surfaces of triangles: which corners and edges they are, gaps
// against all pairs of features and against the separation of boxes, rates against differences.
#include "buckens/loads/polyhedron_touch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/loads/shape_distance.h"
#include "buckens/loads/test/triangle_ball.h"
#include "buckens/loads/test/triangle_block.h"
#include "buckens/spatial/box_separation.h"
#include "buckens/spatial/segment_pair.h"
#include "buckens/spatial/test/found_rates.h"

namespace buckens::loads {
namespace {

using Eigen::Vector3d;
using spatial::MarkerMotion;
using spatial::TouchPlace;
using spatial::TriangleList;
using Solid = std::shared_ptr<const Polyhedron>;

Solid block_of(const Vector3d& half, int n) {
  TriangleList out;
  test::add_block(Vector3d::Zero(), half, n, out);
  return std::make_shared<const Polyhedron>(out);
}

/// Two blocks apart: not convex.
Solid tines(int n) {
  TriangleList out;
  test::add_block({0.15, 0, 0}, {0.05, 0.1, 0.2}, n, out);
  test::add_block({-0.15, 0, 0}, {0.05, 0.1, 0.2}, n, out);
  return std::make_shared<const Polyhedron>(out);
}

Solid ball_of(double radius, int around, int across) {
  return std::make_shared<const Polyhedron>(test::triangle_ball(radius, around, across));
}

/// Two markers near each other, in general position.
struct PlacedSolids {
  test::MarkerPath F, M;
  PlacedSolids(std::mt19937& chance, double apart) {
    std::uniform_real_distribution<double> any(-1, 1);
    const auto vector = [&] { return Vector3d(any(chance), any(chance), any(chance)); };
    for (test::MarkerPath* path : {&F, &M}) {
      *path = {vector(), vector(), vector(), spatial::exp_rotation(3 * vector()).toRotationMatrix(),
               vector(), vector()};
    }
    M.p = F.p + apart * vector().normalized();
  }
};

double least_gap_of(const TouchFinders& finders, const MarkerMotion& F, const MarkerMotion& M) {
  double out = HUGE_VAL;
  for (const auto& finder : finders) {
    TouchPlace place;
    finder->look(F, M, place);
    out = std::min(out, place.gap);
  }
  return out;
}

/// Over all corners and faces, and all pairs of edges. @return negative: a corner is inside
double distance_of_all(const Polyhedron& first, const Polyhedron& second, const MarkerMotion& F,
                       const MarkerMotion& M) {
  double out = HUGE_VAL;
  for (const auto& [own, other, own_at, other_at] :
       {std::tuple{&first, &second, &F, &M}, {&second, &first, &M, &F}}) {
    for (const Polyhedron::Corner& corner : own->corners()) {
      const Vector3d x = own_at->p + own_at->R * corner.at - other_at->p;
      out = std::min(out, other->faces().nearest(other_at->R.transpose() * x).distance);
    }
  }
  for (const Polyhedron::Edge& a : first.edges()) {
    for (const Polyhedron::Edge& b : second.edges()) {
      const Vector3d r = M.p + M.R * b.middle - F.p - F.R * a.middle;
      const Vector3d own = F.R * a.half, other = M.R * b.half;
      const auto at = spatial::NearestOfSegments::of(r, own, other);
      out = std::min(out, (r + at.on_second * other - at.on_first * own).norm());
    }
  }
  return out;
}

/// Whether points close to each other on all edges are outside: corners alone may miss an overlap.
bool are_apart(const Polyhedron& first, const Polyhedron& second, const MarkerMotion& F,
               const MarkerMotion& M) {
  constexpr int kPoints = 200;
  for (const auto& [own, other, own_at, other_at] :
       {std::tuple{&first, &second, &F, &M}, {&second, &first, &M, &F}}) {
    for (const Polyhedron::Edge& edge : own->edges()) {
      for (int k = 0; k <= kPoints; ++k) {
        const Vector3d at = edge.middle + (2.0 * k / kPoints - 1.0) * edge.half;
        const Vector3d x = own_at->p + own_at->R * at - other_at->p;
        if (other->holds(other_at->R.transpose() * x)) return false;
      }
    }
  }
  return true;
}

TEST(PolyhedronTouch, HasTheCornersAndEdgesThatStandOut) {
  for (const int n : {1, 2, 7}) {
    const Solid solid = block_of({0.2, 0.15, 0.1}, n);
    EXPECT_EQ(solid->corners().size(), 8u);
    ASSERT_EQ(solid->edges().size(), 12u);
    double length = 0;
    for (const Polyhedron::Edge& edge : solid->edges()) {
      length += 2 * edge.half.norm();
      // Into both faces, whose normals are at right angles: out is between them, and only there.
      EXPECT_NEAR(edge.into[0].dot(edge.into[1]), 0, 1e-14);
      EXPECT_TRUE(edge.looks_out(-(edge.into[0] + edge.into[1]).normalized()));
      EXPECT_FALSE(edge.looks_out(edge.into[0]));
      EXPECT_LT(edge.middle.normalized().dot(edge.into[0] + edge.into[1]), 0);
    }
    EXPECT_NEAR(length, 4 * (0.4 + 0.3 + 0.2), 1e-13);
  }
  // An L: of its 18 edges the one inside the bend touches nothing.
  TriangleList bend;
  const std::vector<Eigen::Vector2d> outline = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  for (const double z : {0.0, 1.0}) {
    for (const Eigen::Vector2d& x : outline) bend.points.emplace_back(x.x(), x.y(), z);
  }
  for (int k = 0; k < 6; ++k) {
    const int next = (k + 1) % 6;
    bend.triangles.push_back({k, next, 6 + next});
    bend.triangles.push_back({k, 6 + next, 6 + k});
  }
  for (const auto& [a, b, c] : {std::array{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}) {
    bend.triangles.push_back({6 + a, 6 + b, 6 + c});
    bend.triangles.push_back({c, b, a});
  }
  EXPECT_EQ(Polyhedron(bend).edges().size(), 17u);
  EXPECT_EQ(Polyhedron(bend).corners().size(), 12u);
}

TEST(PolyhedronTouch, TheLeastGapIsTheDistance) {
  std::mt19937 chance(3);
  const std::vector<std::pair<Solid, Solid>> pairs = {
      {block_of({0.2, 0.15, 0.1}, 2), block_of({0.1, 0.3, 0.05}, 1)},
      {tines(1), block_of({0.05, 0.2, 0.1}, 1)},
      {block_of({0.2, 0.15, 0.1}, 1), ball_of(0.2, 12, 8)}};
  for (const auto& [first, second] : pairs) {
    // Only singles say how far what is out of reach is.
    const TouchFinders finders = polyhedron_touches(first, second);
    int count = 0;
    for (int k = 0; k < 200; ++k) {
      const PlacedSolids placed(chance, 0.45);
      const MarkerMotion F = placed.F.at(0), M = placed.M.at(0);
      const double all = distance_of_all(*first, *second, F, M);
      // Less than that an edge may pass by between two points.
      if (all <= 1e-3 || !are_apart(*first, *second, F, M)) continue;
      ++count;
      EXPECT_NEAR(least_gap_of(finders, F, M), all, 1e-13);
    }
    EXPECT_GT(count, 50);
  }
}

TEST(PolyhedronTouch, BlocksOverlapWhereBoxesDo) {
  std::mt19937 chance(4);
  spatial::TouchSurface one, other;
  one.half = {0.2, 0.15, 0.1};
  other.half = {0.1, 0.25, 0.12};
  const TouchFinders finders = polyhedron_touches(block_of(one.half, 2), block_of(other.half, 3));
  int inside = 0, outside = 0;
  for (int k = 0; k < 3000; ++k) {
    const PlacedSolids placed(chance, 0.4);
    const MarkerMotion F = placed.F.at(0), M = placed.M.at(0);
    const auto apart = spatial::BoxSeparation::of(one, F.R, other, M.R, M.p - F.p);
    const double gap = least_gap_of(finders, F, M);
    if (apart.gap > 0) {
      ++outside;
      EXPECT_GT(gap, 0);
    } else if (apart.gap > -2e-3) {
      // Places are exact: one of them overlaps, and none less than boxes are known to.
      ++inside;
      EXPECT_LT(gap, 0);
      EXPECT_LE(gap, apart.gap + 1e-3 * 0.1 + 1e-12);
    }
  }
  EXPECT_GT(outside, 300);
  EXPECT_GT(inside, 20);
}

TEST(PolyhedronTouch, APlateBetweenTinesTouchesNeither) {
  const Solid first = tines(2), second = block_of({0.0999, 0.3, 0.15}, 1);
  MarkerMotion F, M;
  for (const double y : {0.0, 0.05, 0.2}) {
    for (const double x : {0.0, 0.00005, -0.00005}) {
      M.p = {x, y, 0.03};
      EXPECT_NEAR(least_gap_of(polyhedron_touches(first, second), F, M), 0.0001 - std::abs(x),
                  1e-14);
    }
  }
  // And one that is taller than the tines touches their edges.
  const Solid tall = block_of({0.0999, 0.05, 0.4}, 1);
  M.p = {0.00004, 0.03, 0};
  EXPECT_NEAR(least_gap_of(polyhedron_touches(first, tall), F, M), 0.00006, 1e-14);
}

TEST(PolyhedronTouch, FacesThatLieOnEachOtherTouchUpToTheirBorders) {
  const Solid first = block_of({0.1, 0.1, 0.1}, 2), second = block_of({0.1, 0.1, 0.1}, 3);
  const TouchFinders finders = polyhedron_touches(first, second);
  MarkerMotion F, M;
  for (const double x : {0.0, 3e-10, 1e-6, 1e-3, 0.05, 0.1997}) {
    for (const double depth : {0.0, 1e-12, 1e-4}) {
      M.p = {x, 0.5 * x, 0.2 - depth};
      double torque = 0, most = 0;
      int count = 0;
      for (const auto& finder : finders) {
        TouchPlace place;
        finder->look(F, M, place);
        EXPECT_GT(place.gap, -depth - 1e-14);
        if (!place.touches || place.gap > 1e-9 - depth) continue;
        ++count;
        // Up, and at the border of the area on all sides.
        EXPECT_NEAR(place.normal.z(), 1, 1e-12);
        torque += place.place.x() - 0.5 * x;
        most = std::max(most, std::abs(place.place.x() - 0.5 * x));
      }
      EXPECT_GE(count, 4);
      EXPECT_NEAR(most, 0.1 - 0.5 * x, 1e-6);
      EXPECT_LT(std::abs(torque), count * most);
    }
  }
}

/// Places in which a box over another touches it without gap, those at the same place once; axes of
/// the first.
std::vector<Vector3d> places(const Vector3d& under, const Vector3d& over, const Vector3d& shift,
                             double turn) {
  MarkerMotion F, M;
  F.R = spatial::exp_rotation({0.3, -0.4, 0.5}).toRotationMatrix();
  M.p = F.R * shift;
  M.R = F.R * spatial::exp_rotation({0, 0, turn}).toRotationMatrix();
  std::vector<Vector3d> out;
  for (const auto& finder : polyhedron_touches(block_of(under, 1), block_of(over, 1))) {
    TouchPlace place;
    finder->look(F, M, place);
    if (!place.touches || std::abs(place.gap) > 1e-12) continue;
    EXPECT_NEAR((F.R.transpose() * place.normal - Vector3d::UnitZ()).norm(), 0, 1e-12);
    const Vector3d at = F.R.transpose() * place.place;
    EXPECT_NEAR(at.z(), under.z(), 1e-12);
    const auto is_same = [&](const Vector3d& x) { return (x - at).norm() < 1e-9; };
    if (std::none_of(out.begin(), out.end(), is_same)) out.push_back(at);
  }
  return out;
}

void expect_rectangle(const std::vector<Vector3d>& found, double from_x, double to_x, double from_y,
                      double to_y) {
  for (const double x : {from_x, to_x}) {
    for (const double y : {from_y, to_y}) {
      const bool is_there = std::any_of(found.begin(), found.end(), [&](const Vector3d& at) {
        return std::hypot(at.x() - x, at.y() - y) < 1e-12;
      });
      EXPECT_TRUE(is_there) << x << " " << y;
    }
  }
  for (const Vector3d& at : found) {
    EXPECT_TRUE(at.x() > from_x - 1e-12 && at.x() < to_x + 1e-12) << at.x();
    EXPECT_TRUE(at.y() > from_y - 1e-12 && at.y() < to_y + 1e-12) << at.y();
  }
}

TEST(PolyhedronTouch, BoxesTouchInAllCornersOfTheirArea) {
  const Vector3d half(0.3, 0.4, 0.2);
  // In line, a small one on a large one and the other way round, shifted, crosswise.
  expect_rectangle(places(half, half, {0, 0, 0.4}, 0), -0.3, 0.3, -0.4, 0.4);
  expect_rectangle(places(half, {0.1, 0.05, 0.2}, {0.1, 0.1, 0.4}, 0), 0, 0.2, 0.05, 0.15);
  expect_rectangle(places({0.1, 0.05, 0.2}, half, {0.1, 0.1, 0.4}, 0), -0.1, 0.1, -0.05, 0.05);
  expect_rectangle(places(half, half, {0.4, 0, 0.4}, 0), 0.1, 0.3, -0.4, 0.4);
  expect_rectangle(places({0.5, 0.1, 0.2}, {0.5, 0.1, 0.2}, {0.1, 0, 0.4}, 0.5 * M_PI), 0, 0.2,
                   -0.1, 0.1);
}

TEST(PolyhedronTouch, SquaresAskewTouchInAnOctagon) {
  const std::vector<Vector3d> found =
      places({0.3, 0.3, 0.2}, {0.3, 0.3, 0.2}, {0, 0, 0.4}, 0.25 * M_PI);
  EXPECT_EQ(found.size(), 8U);
  for (const Vector3d& at : found) {
    EXPECT_NEAR(std::max(std::abs(at.x()), std::abs(at.y())), 0.3, 1e-12);
    EXPECT_NEAR(std::abs(at.x()) + std::abs(at.y()), 0.3 * M_SQRT2, 1e-12);
  }
}

TEST(PolyhedronTouch, EdgesOfBoxesThatCrossTouchInOnePlace) {
  // Both on their edges, one along y, the other along x; apart by 0.01.
  const double reach = 0.2 * M_SQRT2;
  MarkerMotion F, M;
  F.R = spatial::exp_rotation({0, 0.25 * M_PI, 0}).toRotationMatrix();
  M.R = spatial::exp_rotation({0.25 * M_PI, 0, 0}).toRotationMatrix();
  M.p = {0.1, -0.2, 2 * reach + 0.01};
  int count = 0;
  for (const auto& finder :
       polyhedron_touches(block_of({0.2, 0.5, 0.2}, 1), block_of({0.5, 0.2, 0.2}, 1))) {
    TouchPlace place;
    finder->look(F, M, place);
    if (place.gap > 0.02) continue;
    ++count;
    EXPECT_NEAR(place.gap, 0.01, 1e-14);
    EXPECT_NEAR((place.normal - Vector3d::UnitZ()).norm(), 0, 1e-13);
    // On either edge or between them.
    EXPECT_NEAR((place.place - Vector3d(0, -0.2, reach + 0.005)).norm(), 0, 0.005 + 1e-12);
  }
  EXPECT_GE(count, 1);
}

/// Places that touch within a gap, in order of x.
std::vector<TouchPlace> touching(const Solid& first, const Solid& second, const MarkerMotion& F,
                                 const MarkerMotion& M, double gap) {
  std::vector<TouchPlace> out;
  for (const auto& finder : polyhedron_touches(first, second)) {
    TouchPlace place;
    finder->look(F, M, place);
    if (place.touches && std::abs(place.gap) < gap) out.push_back(place);
  }
  const auto is_before = [](const auto& a, const auto& b) { return a.place.x() < b.place.x(); };
  std::sort(out.begin(), out.end(), is_before);
  return out;
}

TEST(PolyhedronTouch, AnEdgeThatDipsOnAPlateHasARowAtEitherBorder) {
  // A beam over a plate, a little lower at one of the borders, or at the other one.
  const Solid plate = block_of({0.1, 0.1, 0.05}, 1), beam = block_of({0.2, 0.05, 0.05}, 1);
  MarkerMotion F, M;
  M.p = {0.01, 0, 0.1};
  for (const double tilt : {-3e-4, -1e-6, 1e-6, 3e-4}) {
    M.R = spatial::exp_rotation({0, tilt, 0}).toRotationMatrix();
    const std::vector<TouchPlace> found = touching(plate, beam, F, M, 1e-3);
    ASSERT_EQ(found.size(), 4U) << tilt;
    for (std::size_t k = 0; k < 4; ++k) {
      const double x = k < 2 ? -0.1 : 0.1;
      EXPECT_NEAR(found[k].place.x(), x, 1e-4);
      // The bottom of the beam there; the rest is of second order.
      EXPECT_NEAR(found[k].gap, -tilt * (x - 0.01), 0.1 * tilt * tilt);
    }
  }
}

TEST(PolyhedronTouch, ACornerDoesNotTouchAFaceIntoWhichItsEdgesLead) {
  // It lies a micron beside the wall, and a millimetre below the top on which its body lies.
  const Solid first = block_of({0.1, 0.1, 0.1}, 1), second = block_of({0.1, 0.1, 0.1}, 1);
  MarkerMotion F, M;
  for (const double beside : {1e-6, 1e-10, -1e-10, -1e-6}) {
    M.p = {beside, -0.1, 0.199};
    for (const TouchPlace& place : touching(first, second, F, M, 2e-3)) {
      EXPECT_NEAR(place.normal.z(), 1.0, 1e-12) << beside;
      EXPECT_NEAR(place.gap, -0.001, 1e-12) << beside;
    }
  }
}

ContactShape flat_box(const Vector3d& half) {
  ContactShape out;
  out.kind = ContactShape::Kind::box;
  out.half = half;
  out.flat = 2;
  return out;
}

/// From where to where flat boxes touch without gap, along the side y of the first.
std::array<double, 2> line_shared(const Vector3d& under, const Vector3d& over,
                                  const Vector3d& shift, double turn) {
  MarkerMotion F, M;
  F.R = spatial::exp_rotation({0, 0, 0.7}).toRotationMatrix();
  M.p = F.R * shift;
  M.R = F.R * spatial::exp_rotation({0, 0, turn}).toRotationMatrix();
  std::array<double, 2> out = {HUGE_VAL, -HUGE_VAL};
  for (const auto& finder : flat_box_touches(flat_box(under), flat_box(over))) {
    TouchPlace place;
    finder->look(F, M, place);
    if (!place.touches || std::abs(place.gap) > 1e-12) continue;
    EXPECT_NEAR((F.R.transpose() * place.normal - Vector3d::UnitY()).norm(), 0, 1e-12);
    const Vector3d at = F.R.transpose() * place.place;
    EXPECT_NEAR(at.y(), under.y(), 1e-12);
    EXPECT_NEAR(at.z(), 0, 1e-12);
    out = {std::min(out[0], at.x()), std::max(out[1], at.x())};
  }
  return out;
}

TEST(FlatBoxTouch, BoxesTouchAtBothEndsOfTheLineThatTheyShare) {
  const Vector3d half(0.3, 0.2, 1), small(0.1, 0.2, 0.01);
  const auto expect_line = [](const std::array<double, 2>& found, double from, double to) {
    EXPECT_NEAR(found[0], from, 1e-12);
    EXPECT_NEAR(found[1], to, 1e-12);
  };
  expect_line(line_shared(half, half, {0, 0.4, 0}, 0), -0.3, 0.3);
  expect_line(line_shared(half, half, {0.4, 0.4, 0}, 0), 0.1, 0.3);
  expect_line(line_shared(half, small, {0.1, 0.4, 0}, 0), 0, 0.2);
  expect_line(line_shared(small, half, {0.1, 0.4, 0}, 0), -0.1, 0.1);
  expect_line(line_shared(half, {0.2, 0.1, 1}, {0, 0.4, 0}, 0.5 * M_PI), -0.1, 0.1);
}

TEST(FlatBoxTouch, TheGapIsThatOfTheSeparation) {
  // Apart or up to a twentieth of the smaller one into each other: along the axis of least overlap.
  std::mt19937 chance(3);
  std::uniform_real_distribution<double> any(-1, 1);
  int count = 0, beside = 0;
  for (int k = 0; k < 5000; ++k) {
    const ContactShape one = flat_box({0.3 + 0.2 * any(chance), 0.3, 1});
    const ContactShape other = flat_box({0.2, 0.3 + 0.2 * any(chance), 0.5});
    MarkerMotion F, M;
    M.p = Vector3d(any(chance), any(chance), 0);
    M.R = spatial::exp_rotation({0, 0, 3 * any(chance)}).toRotationMatrix();
    const auto apart =
        spatial::BoxSeparation::of(touch_surface(one), F.R, touch_surface(other), M.R, M.p);
    if (std::abs(apart.gap) > 0.01) continue;
    double least = HUGE_VAL;
    for (const auto& finder : flat_box_touches(one, other)) {
      TouchPlace place;
      finder->look(F, M, place);
      if (place.touches) least = std::min(least, place.gap);
    }
    // Corner at corner, neither of which lies over a side, has a gap, but no place.
    if (apart.gap > 0.0) {
      EXPECT_GE(least, apart.gap - 1e-12);
      continue;
    }
    // No overlap is missed. Where a corner came in beside another corner, its own side says more.
    EXPECT_LE(least, apart.gap + 1e-12);
    ++count;
    beside += least < apart.gap - 1e-12 ? 1 : 0;
  }
  EXPECT_GT(count, 10);
  EXPECT_LT(beside, count / 3);
}

/// Whether a finder goes over to another feature within the differences.
bool jumps(const spatial::TouchFinder& finder, const PlacedSolids& placed) {
  TouchPlace now, then;
  finder.look(placed.F.at(0), placed.M.at(0), now);
  for (const double t : {-4e-4, -2e-4, 2e-4, 4e-4}) {
    finder.look(placed.F.at(t), placed.M.at(t), then);
    const bool is_other = then.touches != now.touches || (then.normal - now.normal).norm() > 0.02 ||
                          (then.place - now.place).norm() > 0.02 ||
                          (then.normal_rate - now.normal_rate).norm() > 0.2;
    if (is_other) return true;
  }
  return false;
}

TEST(PolyhedronTouch, PlacesMoveAsTheirRatesSay) {
  std::mt19937 chance(6);
  const std::vector<std::pair<Solid, Solid>> pairs = {
      {block_of({0.2, 0.15, 0.1}, 1), block_of({0.1, 0.3, 0.05}, 2)},
      {ball_of(0.2, 16, 10), block_of({0.2, 0.15, 0.1}, 1)},
      {block_of({0.2, 0.15, 0.1}, 1), ball_of(0.2, 16, 10)},
      {ball_of(0.2, 16, 10), ball_of(0.25, 20, 12)}};
  for (const auto& [first, second] : pairs) {
    const TouchFinders finders = polyhedron_touches(first, second);
    int count = 0, overlaps = 0;
    for (int k = 0; k < 40; ++k) {
      const PlacedSolids placed(chance, 0.38);
      for (const auto& finder : finders) {
        TouchPlace place;
        finder->look(placed.F.at(0), placed.M.at(0), place);
        // Next to an edge or a corner beside it, normals turn too fast for differences; and where
        // the nearest place is another one a moment later, there are none.
        if ((!place.touches && std::abs(place.gap) < 0.02) || jumps(*finder, placed)) continue;
        const int is_smooth = test::expect_rates(*finder, placed.F, placed.M);
        count += is_smooth;
        overlaps += is_smooth != 0 && place.gap < 0 ? 1 : 0;
      }
    }
    EXPECT_GT(count, 500);
    EXPECT_GT(overlaps, 5);
  }
}

}  // namespace
}  // namespace buckens::loads
