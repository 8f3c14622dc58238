// SPDX-License-Identifier: Apache-2.0
// Impulses with friction: conditions of Coulomb and of one-sided rows, and closed forms.
#include "buckens/stepping/friction_impulses.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

namespace buckens::stepping {
namespace {

using linalg::Matrix;
using linalg::Vector;

TEST(FrictionImpulses, OfASphereOnAPlaneAreTheClosedForm) {
  // Mass 2, solid: the slip answers with 7/2 of the inverse mass.
  const Matrix D = Eigen::Vector3d(0.5, 1.75, 1.75).asDiagonal();
  const Eigen::Vector2d slip(0.6, -0.8);
  Vector b(3);
  b << 4.0, -slip;  // it comes with 4/(1 + e)
  for (const double mu : {0.02, 0.05, 0.1, 1.0}) {
    const Vector P = solve_impact(D, b, 1, {{0, 1, 2, mu}});
    EXPECT_NEAR(P[0], 8.0, 1e-13);
    const double size = std::min(mu * 8.0, 2.0 / 7.0 * 2.0);
    EXPECT_NEAR((P.tail<2>() + size * slip).norm(), 0, 1e-13) << mu;
  }
}

TEST(FrictionImpulses, LeaveOutDirectionsThatGuidesHold) {
  // Without slip and without an answer, alone and beside a direction that slips.
  const Matrix guided = Eigen::Vector2d(0.5, 0.0).asDiagonal();
  const Vector none = solve_impact(guided, Eigen::Vector2d(4.0, 0.0), 1, {{0, 1, 1, 0.3}});
  EXPECT_NEAR((none - Eigen::Vector2d(8.0, 0.0)).norm(), 0, 1e-13);
  const Matrix along_rail = Eigen::Vector3d(0.5, 1.75, 1e-17).asDiagonal();
  const Vector P =
      solve_impact(along_rail, Eigen::Vector3d(4.0, -10.0, 1e-18), 1, {{0, 1, 2, 0.1}});
  EXPECT_NEAR((P - Eigen::Vector3d(8.0, -0.8, 0.0)).norm(), 0, 1e-13);
}

TEST(FrictionImpulses, SatisfyCoulombAndOneSidedRows) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> between(-1, 1);
  for (int trial = 0; trial < 100; ++trial) {
    // Three places on bodies with eight coordinates.
    const Eigen::Index places = 3;
    Matrix J(9, 8);
    for (double& value : J.reshaped()) value = between(random);
    const Matrix D = J * J.transpose() + 0.02 * Matrix::Identity(9, 9);
    Vector b(9);
    for (double& value : b) value = between(random);
    std::vector<ImpactSlip> slips;
    for (Eigen::Index k = 0; k < places; ++k) slips.push_back({k, places + 2 * k, 2, 0.2});
    const Vector P = solve_impact(D, b, places, slips);
    const Vector w = D * P - b;
    const double size = P.cwiseAbs().maxCoeff() + 1;
    for (const ImpactSlip& slip : slips) {
      const double press = P[slip.across];
      EXPECT_GE(press, 0);
      EXPECT_GE(w[slip.across], -1e-10 * size);
      EXPECT_NEAR(press * w[slip.across], 0, 1e-10 * size * size);
      const Vector rub = P.segment(slip.first, 2);
      const Vector v = w.segment(slip.first, 2);
      EXPECT_LE(rub.norm(), slip.coefficient * press * (1 + 1e-12) + 1e-15);
      // It stops, or slides on against the whole of the friction.
      if (v.norm() > 1e-9 * size) {
        EXPECT_NEAR((rub * v.norm() + slip.coefficient * press * v).norm(), 0, 1e-9 * size * size);
      }
    }
  }
}

TEST(FrictionImpulses, AreSharedWhereRowsHoldTheSame) {
  // Two corners of a sliding block that press and rub on one line: their slips are the same.
  Matrix J(4, 3);
  const double w = 0.2, h = 0.1;
  J << 0, 1, w, 0, 1, -w, 1, 0, h, 1, 0, h;
  const Matrix D = J * Eigen::Vector3d(0.5, 0.5, 20.0).asDiagonal() * J.transpose();
  Vector b(4);
  b << 1, 1, -0.1, -0.1;
  const Vector P = solve_impact(D, b, 2, {{0, 2, 1, 0.9}, {1, 3, 1, 0.9}});
  const Vector after = D * P - b;
  EXPECT_NEAR(after.norm(), 0, 1e-11);  // all of them stop
  EXPECT_NEAR(P[0] + P[1], 2, 1e-11);
  EXPECT_GT(P[0], 0);
  EXPECT_GT(P[1], 0);
}

}  // namespace
}  // namespace buckens::stepping
