// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/ball_bending.h"

#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include "buckens/loads/bristle_bending.h"
#include "buckens/spatial/rotation.h"

namespace buckens::loads {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kSliding = 1e-3;

TEST(BallBending, IsThatOfOneDirectionAlongALine) {
  const Vector3d e = Vector3d(2, -1, 2) / 3.0;
  for (const double share : {0.0, 0.5, 0.9, 1.0}) {
    for (const double z : {-1.5, -0.6, 0.0, 0.3, 0.8, 0.97, 1.0, 1.3}) {
      for (const double way : {1e-3, 0.4, 3.0, 50.0, 70.0}) {
        const std::array<double, 2> sliding{kSliding, 0.8 * kSliding};
        const double one = bent_over(way * kSliding, z * kSliding, sliding, share);
        const Vector3d all =
            BallBending(share).after({way * kSliding * e, z * kSliding * e, sliding});
        EXPECT_LT((all - one * e).norm(), 1e-12 * kSliding) << share << ' ' << z << ' ' << way;
      }
    }
  }
}

TEST(BallBending, DependsOnThePoseAloneWhileNothingSlips) {
  // A walk of hundreds of rotations within nine tenths of the deflection at which it slides, of a
  // hundredth of a radian, and back: rotations do not commute, and their sum is not zero.
  const BallBending bending(0.9);
  const double sliding = 0.01;
  std::srand(5);
  Vector3d z = Vector3d::Zero(), sum = Vector3d::Zero();
  Quaterniond pose = Quaterniond::Identity();
  const auto turn_to = [&](const Quaterniond& next) {
    const Vector3d turned = spatial::log_rotation(next * pose.conjugate());
    z = bending.after({turned, z, {sliding, sliding}});
    sum += turned;
    pose = next;
  };
  for (int k = 0; k < 500; ++k) {
    turn_to(spatial::exp_rotation(0.5 * sliding * Vector3d::Random()));
    EXPECT_LT((z - spatial::log_rotation(pose)).norm(), 1e-13);
  }
  turn_to(Quaterniond::Identity());
  EXPECT_LT(z.norm(), 1e-13);
  EXPECT_GT(sum.norm(), 1e-5);
}

TEST(BallBending, FollowsAWayThatTurns) {
  for (const double share : {0.3, 0.9}) {
    const BallBending bending(share);
    // A whole turn in 100 deflections: bristles lie behind the way by the angle of their length.
    const double length = 100.0 * kSliding;
    constexpr int kParts = 20000;
    Vector3d z = Vector3d::Zero();
    double taken = 0;
    for (int k = 0; k < kParts; ++k) {
      const double at = 2.0 * M_PI * (k + 0.5) / kParts;
      const Vector3d way = length / kParts * Vector3d(std::cos(at), std::sin(at), 0.0);
      const Vector3d before = z;
      z = bending.after({way, z, {kSliding, kSliding}});
      taken += 0.5 * (before + z).dot(way) - 0.5 * (z.squaredNorm() - before.squaredNorm());
    }
    EXPECT_NEAR(z.norm(), kSliding, 1e-6 * kSliding);
    const double lag = kSliding * 2.0 * M_PI / length;
    EXPECT_NEAR(std::atan2(-z[1], z[0]), lag, 0.02 * lag);
    // All of the sliding, less what bending the bristles took: the bound times the way.
    EXPECT_NEAR(taken, kSliding * length, 0.02 * kSliding * length);
  }
}

TEST(BallBending, TakesEnergyAndNeverGivesAny) {
  std::srand(7);
  for (const double share : {0.3, 0.9}) {
    const BallBending bending(share);
    Vector3d z = Vector3d::Zero();
    for (int k = 0; k < 500; ++k) {
      const Vector3d way = 3.0 * kSliding * Vector3d::Random();
      double taken = 0;
      constexpr int kParts = 300;
      for (int i = 0; i < kParts; ++i) {
        const Vector3d before = z;
        z = bending.after({way / kParts, z, {kSliding, kSliding}});
        taken +=
            0.5 * (before + z).dot(way) / kParts - 0.5 * (z.squaredNorm() - before.squaredNorm());
      }
      EXPECT_GT(taken, -1e-6 * kSliding * kSliding);
      EXPECT_LT(z.norm(), (1.0 + 1e-5) * kSliding);
    }
  }
}

/// Derivatives of a function of a vector by central differences.
template <class F>
Matrix3d differences(double step, F&& f) {
  Matrix3d out;
  for (int k = 0; k < 3; ++k) {
    const Vector3d shift = step * Vector3d::Unit(k);
    out.col(k) = (f(shift) - f(-shift)) / (2.0 * step);
  }
  return out;
}

TEST(BallBending, TellsItsDerivatives) {
  std::srand(3);
  for (const double share : {0.0, 0.3, 0.9}) {
    const BallBending bending(share);
    for (const double length : {0.01, 0.5, 1.0, 4.0, 30.0, 100.0}) {
      for (int k = 0; k < 20; ++k) {
        const std::array<double, 2> sliding{kSliding, 0.9 * kSliding};
        const Vector3d z = 0.95 * kSliding * Vector3d::Random().normalized();
        const Vector3d turned = length * kSliding * Vector3d::Random().normalized();
        const Matrix3d by_turn = bending.by_turn({turned, z, sliding});
        const Matrix3d turn = differences(1e-5 * kSliding, [&](const Vector3d& shift) {
          const Quaterniond next = spatial::exp_rotation(shift) * spatial::exp_rotation(turned);
          return bending.after({spatial::log_rotation(next), z, sliding});
        });
        // Terms of the second order in z are left out.
        EXPECT_LT((by_turn - turn).norm(), 2e-5) << share << ' ' << length << '\n' << turn;
        const Vector3d w = Vector3d::Random();
        const BallBending::Slopes slopes = bending.slopes(z, w, kSliding);
        const Matrix3d by_z = differences(1e-6 * kSliding, [&](const Vector3d& shift) {
          return bending.rate(z + shift, w, kSliding);
        });
        const Matrix3d by_rate = differences(
            1e-6, [&](const Vector3d& shift) { return bending.rate(z, w + shift, kSliding); });
        // Those of J_l⁻¹ by z are left out beyond the first.
        EXPECT_LT((slopes.by_z - by_z).norm(), 1e-5 * by_z.norm() + kSliding * w.norm()) << share;
        EXPECT_LT((slopes.by_rate - by_rate).norm(), 1e-6) << share;
      }
    }
  }
}

}  // namespace
}  // namespace buckens::loads
