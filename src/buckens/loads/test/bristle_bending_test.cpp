// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/bristle_bending.h"

#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

namespace buckens::loads {
namespace {

using Eigen::Vector3d;

constexpr double kSliding = 1e-4;

TEST(BristleBending, IsThatOfOneDirectionAlongALine) {
  const Vector3d e = Vector3d(2, -1, 2) / 3.0;
  for (const double share : {0.0, 0.5, 0.9, 1.0}) {
    for (const double z : {-1.5e-4, -6e-5, 0.0, 3e-5, 8e-5, 9.7e-5, 1e-4, 1.3e-4}) {
      for (const double way : {1e-7, 4e-5, 3e-4, 5e-3, 7e-3}) {
        const double one = bent_over(way, z, {kSliding, 0.8 * kSliding}, share);
        const Vector3d all =
            bent_over(Vector3d(way * e), Vector3d(z * e), {kSliding, 0.8 * kSliding}, share);
        EXPECT_LT((all - one * e).norm(), 1e-13 * kSliding) << share << ' ' << z << ' ' << way;
      }
    }
  }
}

/// Deflection, and what friction takes per stiffness, along a way that turns by a given angle.
Vector3d along_an_arc(double length, double angle, double share, int parts, double& taken) {
  Vector3d z = Vector3d::Zero();
  taken = 0.0;
  for (int k = 0; k < parts; ++k) {
    const double at = angle * (k + 0.5) / parts;
    const Vector3d way = length / parts * Vector3d(std::cos(at), std::sin(at), 0.0);
    const Vector3d before = z;
    z = bent_over(way, z, {kSliding, kSliding}, share);
    taken += 0.5 * (before + z).dot(way) - 0.5 * (z.squaredNorm() - before.squaredNorm());
  }
  return z;
}

TEST(BristleBending, FollowsAWayThatTurns) {
  for (const double share : {0.3, 0.9}) {
    double taken = 0;
    // A whole turn in 100 deflections: bristles lie behind the way by the angle of their length.
    const double length = 100.0 * kSliding;
    const Vector3d z = along_an_arc(length, 2.0 * M_PI, share, 20000, taken);
    EXPECT_NEAR(z.norm(), kSliding, 1e-6 * kSliding);
    const double lag = kSliding * 2.0 * M_PI / length;
    EXPECT_NEAR(std::atan2(-z[1], z[0]), lag, 0.01 * lag);
    // All of the sliding, less what bending the bristles took: the bound times the way.
    EXPECT_NEAR(taken, kSliding * length, 0.02 * kSliding * length);
  }
}

TEST(BristleBending, TakesEnergyAndNeverGivesAny) {
  // Ways of every direction, of up to three deflections.
  std::srand(7);
  for (const double share : {0.3, 0.9}) {
    Vector3d z = Vector3d::Zero();
    for (int k = 0; k < 2000; ++k) {
      const Vector3d way = 3.0 * kSliding * Vector3d::Random();
      double taken = 0;
      constexpr int kParts = 300;
      for (int i = 0; i < kParts; ++i) {
        const Vector3d before = z;
        z = bent_over(Vector3d(way / kParts), z, {kSliding, kSliding}, share);
        taken +=
            0.5 * (before + z).dot(way) / kParts - 0.5 * (z.squaredNorm() - before.squaredNorm());
      }
      EXPECT_GT(taken, -1e-6 * kSliding * kSliding);
      EXPECT_LT(z.norm(), (1.0 + 1e-5) * kSliding);
    }
  }
}

TEST(BristleBending, IsElasticBelowItsShare) {
  // Around a square within nine tenths of the deflection: back where it was.
  Vector3d z = Vector3d::Zero();
  const double side = 0.6 * kSliding;
  for (const Vector3d& way :
       {Vector3d(side, 0, 0), Vector3d(0, side, 0), Vector3d(-side, 0, 0), Vector3d(0, -side, 0)}) {
    z = bent_over(way, z, {kSliding, kSliding}, 0.9);
  }
  EXPECT_LT(z.norm(), 1e-15 * kSliding);
}

}  // namespace
}  // namespace buckens::loads
