// SPDX-License-Identifier: Apache-2.0
// Ways of surfaces that touch against differences.
#include "buckens/joints/contact_way.h"

#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/spatial/test/marker_path.h"

namespace buckens::joints {
namespace {

using Eigen::Vector3d;
using spatial::RigidTouch;
using spatial::TouchSurface;
using test::MarkerPath;
using Way = ContactWay::Direction;

using Feature = RigidTouch::Feature;

TouchSurface surface(TouchSurface::Kind kind) {
  TouchSurface out;
  out.kind = kind;
  out.axis = Vector3d(0.3, -0.2, 0.9).normalized();
  const bool is_hollow = kind == TouchSurface::Kind::socket || kind == TouchSurface::Kind::bore;
  out.radius = is_hollow ? 2.0 : 0.4;
  out.half_length = 0.5;
  out.half = {0.5, 0.4, 0.3};
  return out;
}

/// Surfaces, and points near each of their sides, edges, corners and ends in their axes.
std::vector<std::pair<TouchSurface, Vector3d>> looks() {
  using enum TouchSurface::Kind;
  const Vector3d axis = surface(plane).axis, beside = axis.unitOrthogonal();
  return {{surface(plane), {0.2, 0.5, -0.3}},
          {surface(sphere), {0.2, 0.5, -0.3}},
          {surface(socket), {0.2, 0.5, -1.3}},
          {surface(bore), {0.8, 0.5, -0.3}},
          {surface(capsule), 0.2 * axis + 0.7 * beside},
          {surface(capsule), -0.9 * axis + 0.3 * beside},
          {surface(cylinder), 0.2 * axis + 0.7 * beside},
          {surface(cylinder), -0.8 * axis + 0.2 * beside},
          {surface(cylinder), 0.8 * axis - 0.6 * beside},
          {surface(box), {0.1, 0.2, -0.6}},
          {surface(box), {-0.7, 0.2, 0.5}},
          {surface(box), {0.7, -0.5, 0.5}}};
}

/// @param F,M where both markers are
std::vector<RigidTouch::Data> touches(const spatial::MarkerMotion& F,
                                      const spatial::MarkerMotion& M) {
  std::vector<RigidTouch::Data> out;
  RigidTouch::Data data;
  data.pole = Vector3d(0.1, 0.9, 0.2).normalized();
  data.radius = 0.1;
  for (const auto& [shape, point] : looks()) {
    data.surface = shape;
    data.feature = Feature::point_of_second;
    data.at = M.R.transpose() * (F.p + F.R * point - M.p);
    out.push_back(data);
    data.feature = Feature::point_of_first;
    data.at = F.R.transpose() * (M.p + M.R * point - F.p);
    out.push_back(data);
  }
  data.feature = Feature::rim;
  data.surface = surface(TouchSurface::Kind::plane);
  data.axis = Vector3d(0.8, 0.3, -0.4).normalized();
  data.at = 0.3 * data.axis;
  out.push_back(data);
  // Capsules that are nearest between their ends, at an end of either, and at ends of both.
  data.feature = Feature::axes;
  data.surface = surface(TouchSurface::Kind::capsule);
  const Vector3d from = F.R.transpose() * (M.p - F.p);
  const Vector3d across = from.unitOrthogonal();
  const Vector3d beside = from.normalized().cross(across);
  data.half_length = 0.6;
  for (const double first : {0.0, 2.0}) {
    for (const double second : {0.0, 2.0}) {
      data.surface.axis = (across + first * from.normalized()).normalized();
      data.axis = M.R.transpose() * F.R * (beside + second * from.normalized()).normalized();
      out.push_back(data);
    }
  }
  return out;
}

TEST(ContactWay, RateAndAccelerationAcrossAreThoseOfTheGap) {
  const MarkerPath F = MarkerPath::some(3);
  const MarkerPath M = MarkerPath::some(4);
  Eigen::Matrix<double, 12, 1> V, A;
  V << F.w, F.v, M.w, M.v;
  A << F.alpha, F.a, M.alpha, M.a;
  for (const RigidTouch::Data& data : touches(F.at(0), M.at(0))) {
    const ContactWay way{RigidTouch(data), Way::across};
    const auto gap = [&](double t) { return way.gap(F.at(t), M.at(t)); };
    const spatial::PairRow J = way.derivatives(F.at(0), M.at(0));
    // Fourth-order differences over 1e-3 of quantities of one.
    EXPECT_NEAR(J.dot(V), test::derivative(gap), 1e-8);
    EXPECT_NEAR(J.dot(A) + way.bias(F.at(0), M.at(0), {}, {}), test::second_derivative(gap), 1e-5);
  }
}

TEST(ContactWay, DirectionsAreThoseOfTheSurface) {
  const MarkerPath F = MarkerPath::some(5);
  const MarkerPath M = MarkerPath::some(6);
  for (const RigidTouch::Data& data : touches(F.at(0), M.at(0))) {
    const RigidTouch touch(data);
    for (const double t : {0.0, 0.1, 0.2}) {
      const spatial::TouchPlace place = touch.look(F.at(t), M.at(t));
      EXPECT_NEAR(place.along[0].norm(), 1, 1e-13);
      EXPECT_NEAR(place.along[0].dot(place.normal), 0, 1e-13);
      EXPECT_NEAR((place.normal.cross(place.along[0]) - place.along[1]).norm(), 0, 1e-13);
    }
  }
  // The normal as placed is the pole; opposite to it there are directions, too.
  RigidTouch::Data sphere;
  sphere.surface = surface(TouchSurface::Kind::sphere);
  spatial::MarkerMotion at_home;
  spatial::MarkerMotion opposite;
  opposite.p = -sphere.pole;
  const spatial::TouchPlace place = RigidTouch(sphere).look(at_home, opposite);
  EXPECT_NEAR(place.along[0].dot(place.normal), 0, 1e-14);
  EXPECT_NEAR((place.normal.cross(place.along[0]) - place.along[1]).norm(), 0, 1e-13);
}

TEST(ContactWay, PlacesMoveAsTheirRatesSay) {
  const MarkerPath F = MarkerPath::some(7);
  const MarkerPath M = MarkerPath::some(8);
  for (const RigidTouch::Data& data : touches(F.at(0), M.at(0))) {
    const RigidTouch touch(data);
    const spatial::TouchPlace place = touch.look(F.at(0), M.at(0));
    // Fourth-order differences over 2e-4 of quantities of ten.
    for (int k = 0; k < 3; ++k) {
      const auto at = [&](double t) { return touch.look(F.at(t), M.at(t)).place[k]; };
      const auto normal = [&](double t) { return touch.look(F.at(t), M.at(t)).normal[k]; };
      EXPECT_NEAR(place.place_rate[k], test::derivative(at, 2e-4), 1e-9);
      EXPECT_NEAR(place.normal_rate[k], test::derivative(normal, 2e-4), 1e-9);
    }
  }
}

TEST(ContactWay, ABallThatRollsDoesNotSlip) {
  RigidTouch::Data data;
  data.radius = 0.1;
  const ContactWay way{RigidTouch(data), Way::along};
  spatial::MarkerMotion F, M;
  M.p = {0.3, 0.2, 0.1};
  M.v = {2, 1, 0};
  M.w = Vector3d(0, 0, 1).cross(M.v) / 0.1;
  Eigen::Matrix<double, 12, 1> V;
  V << F.w, F.v, M.w, M.v;
  EXPECT_NEAR(way.derivatives(F, M).dot(V), 0, 1e-14);
  // At constant speed on a plane at rest it does not accelerate along it.
  EXPECT_NEAR(way.bias(F, M, {}, {}), 0, 1e-13);
}

}  // namespace
}  // namespace buckens::joints
