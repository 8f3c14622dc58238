// SPDX-License-Identifier: Apache-2.0
// Newton's method for impulses with friction: closed forms, and places that hold the same.
#include "buckens/stepping/cone_newton.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace buckens::stepping {
namespace {

using linalg::Matrix;
using linalg::Vector;

TEST(ConeNewton, FindsTheClosedFormOfASphereOnAPlane) {
  // Mass 2, solid: the slip answers with 7/2 of the inverse mass.
  const Matrix D = Eigen::Vector3d(0.5, 1.75, 1.75).asDiagonal();
  const Eigen::Vector2d slip(0.6, -0.8);
  Vector b(3);
  b << 4.0, -slip;
  for (const double mu : {0.02, 0.05, 0.1, 1.0}) {
    Vector P = Eigen::Vector3d(8, 0, 0);
    ASSERT_TRUE(find_by_newton(D, b, {{{0, 1, 2}, mu}}, P));
    const double size = std::min(mu * 8.0, 2.0 / 7.0 * 2.0);
    EXPECT_NEAR(P[0], 8.0, 1e-12);
    EXPECT_NEAR((P.tail<2>() + size * slip).norm(), 0, 1e-12) << mu;  // a few roundings of 8
  }
}

TEST(ConeNewton, LeavesWhatPartsWithoutImpulse) {
  const Matrix D = Eigen::Vector3d(0.5, 1.75, 1.75).asDiagonal();
  Vector P = Eigen::Vector3d(3, 1, 0);
  ASSERT_TRUE(find_by_newton(D, Eigen::Vector3d(-1, 2, 0), {{{0, 1, 2}, 0.5}}, P));
  EXPECT_EQ(P.norm(), 0);
}

TEST(ConeNewton, SharesWhatPlacesHoldTogether) {
  // A cube of side 2 and mass 1 on its four lower corners is pushed along by 0.3 and pressed by 1:
  // three of four impulses across are independent, five of eight along are not.
  Matrix J(12, 6);
  const double x[] = {1, 1, -1, -1}, y[] = {1, -1, 1, -1};
  for (int k = 0; k < 4; ++k) {
    // Directions and levers of z, x and y at (x, y, −1).
    J.row(3 * k) << 0, 0, 1, y[k], -x[k], 0;
    J.row(3 * k + 1) << 1, 0, 0, 0, -1, -y[k];
    J.row(3 * k + 2) << 0, 1, 0, 1, 0, x[k];
  }
  Vector mobility(6);
  mobility << 1, 1, 1, 1.5, 1.5, 1.5;
  const Matrix D = J * mobility.asDiagonal() * J.transpose();
  Vector V(6);
  V << 0.3, 0, -1, 0, 0, 0;
  const Vector b = -(J * V);
  std::vector<ConeRows> places;
  for (Eigen::Index k = 0; k < 4; ++k) places.push_back({{3 * k, 3 * k + 1, 3 * k + 2}, 0.5});
  Vector P = Vector::Zero(12);
  for (Eigen::Index k = 0; k < 4; ++k) P[3 * k] = 0.25;
  ASSERT_TRUE(find_by_newton(D, b, places, P));
  EXPECT_NEAR((D * P - b).norm(), 0, 1e-11);  // 0.3 < 0.5: it stops, and does not tilt
  double press = 0, rub = 0;
  for (Eigen::Index k = 0; k < 4; ++k) {
    press += P[3 * k];
    rub += P[3 * k + 1];
    EXPECT_LE(P.segment(3 * k + 1, 2).norm(), 0.5 * P[3 * k] + 1e-12);
  }
  EXPECT_NEAR(press, 1, 1e-12);
  EXPECT_NEAR(rub, -0.3, 1e-12);
}

}  // namespace
}  // namespace buckens::stepping
