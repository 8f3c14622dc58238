// SPDX-License-Identifier: Apache-2.0
// Ways of surfaces that touch against differences.
#include "buckens/joints/contact_way.h"

#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/spatial/test/marker_path.h"

namespace buckens::joints {
namespace {

using Eigen::Vector3d;
using spatial::RigidTouch;
using test::MarkerPath;
using Way = ContactWay::Direction;

std::vector<RigidTouch::Data> surfaces() {
  RigidTouch::Data plane;
  plane.axis = Vector3d(0.3, -0.2, 0.9).normalized();
  plane.radius = 0.1;
  plane.at = {0.2, 0.1, -0.3};
  RigidTouch::Data sphere;
  sphere.surface = RigidTouch::Surface::sphere;
  sphere.axis = Vector3d(0.1, 0.9, 0.2).normalized();
  sphere.first_radius = 0.4;
  sphere.radius = 0.2;
  RigidTouch::Data socket = sphere;
  socket.surface = RigidTouch::Surface::socket;
  socket.first_radius = 2.0;
  return {plane, sphere, socket};
}

TEST(ContactWay, RateAndAccelerationAcrossAreThoseOfTheGap) {
  const MarkerPath F = MarkerPath::some(3);
  const MarkerPath M = MarkerPath::some(4);
  Eigen::Matrix<double, 12, 1> V, A;
  V << F.w, F.v, M.w, M.v;
  A << F.alpha, F.a, M.alpha, M.a;
  for (const RigidTouch::Data& data : surfaces()) {
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
  for (const RigidTouch::Data& data : surfaces()) {
    const RigidTouch touch(data);
    for (const double t : {0.0, 0.1, 0.2}) {
      const spatial::TouchPlace place = touch.look(F.at(t), M.at(t));
      EXPECT_NEAR(place.along[0].norm(), 1, 1e-14);
      EXPECT_NEAR(place.along[0].dot(place.normal), 0, 1e-14);
      EXPECT_NEAR((place.normal.cross(place.along[0]) - place.along[1]).norm(), 0, 1e-13);
    }
    // The normal as placed is the pole; opposite to it there are directions, too.
    spatial::MarkerMotion at_home;
    spatial::MarkerMotion opposite;
    opposite.p = -data.axis;
    const spatial::TouchPlace place = touch.look(at_home, opposite);
    EXPECT_NEAR(place.along[0].dot(place.normal), 0, 1e-14);
    EXPECT_NEAR((place.normal.cross(place.along[0]) - place.along[1]).norm(), 0, 1e-13);
  }
}

TEST(ContactWay, PlacesMoveAsTheirRatesSay) {
  const MarkerPath F = MarkerPath::some(7);
  const MarkerPath M = MarkerPath::some(8);
  for (const RigidTouch::Data& data : surfaces()) {
    const RigidTouch touch(data);
    const spatial::TouchPlace place = touch.look(F.at(0), M.at(0));
    for (int k = 0; k < 3; ++k) {
      const auto at = [&](double t) { return touch.look(F.at(t), M.at(t)).place[k]; };
      const auto normal = [&](double t) { return touch.look(F.at(t), M.at(t)).normal[k]; };
      EXPECT_NEAR(place.place_rate[k], test::derivative(at), 1e-8);
      EXPECT_NEAR(place.normal_rate[k], test::derivative(normal), 1e-8);
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
