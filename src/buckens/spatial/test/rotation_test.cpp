// SPDX-License-Identifier: Apache-2.0
#include "buckens/spatial/rotation.h"

#include <cmath>

#include <gtest/gtest.h>

#include "buckens/spatial/pose.h"
#include "buckens/spatial/principal_axes.h"

namespace buckens::spatial {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

const Vector3d kTheta(0.7, -1.1, 0.4);
const Vector3d kRate(-0.3, 0.8, 1.7);

/// x with x~ the skew part of A.
Vector3d axial(const Matrix3d& A) {
  return 0.5 * Vector3d(A(2, 1) - A(1, 2), A(0, 2) - A(2, 0), A(1, 0) - A(0, 1));
}

TEST(Rotation, SkewIsTheCrossProduct) {
  EXPECT_EQ(skew(kTheta) * kRate, kTheta.cross(kRate));
  EXPECT_EQ(axial(skew(kTheta)), kTheta);
}

TEST(Rotation, ExponentialEqualsAngleAxis) {
  for (const double angle : {0.0, 1e-12, 1e-5, 9.9e-5, 1.1e-4, 0.3, 3.0, 6.0}) {
    const Vector3d axis = kTheta.normalized();
    const Matrix3d expected = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    const Matrix3d found = exp_rotation(angle * axis).toRotationMatrix();
    EXPECT_LE((found - expected).norm(), 1e-15 * 4) << angle;  // a few roundings
  }
}

TEST(Rotation, LogarithmInvertsTheExponential) {
  for (const double angle : {0.0, 1e-14, 1e-9, 1e-5, 0.5, 2.0, 3.14}) {
    const Vector3d psi = angle * kTheta.normalized();
    EXPECT_LE((log_rotation(exp_rotation(psi)) - psi).norm(), 1e-15 * (1 + 10 * angle)) << angle;
    const Quaterniond q = exp_rotation(psi);
    const Quaterniond same(-q.w(), -q.x(), -q.y(), -q.z());
    EXPECT_LE((log_rotation(same) - psi).norm(), 1e-15 * (1 + 10 * angle)) << angle;
  }
}

TEST(Rotation, LeftJacobianGivesTheAngularVelocity) {
  for (const double size : {0.0, 1e-6, 0.9e-3, 1.1e-3, 0.5, 2.0}) {
    const Vector3d theta = size * kTheta;
    const double tau = 1e-5;
    const Matrix3d R = exp_rotation(theta).toRotationMatrix();
    const Matrix3d R_dot = (exp_rotation(theta + tau * kRate).toRotationMatrix() -
                            exp_rotation(theta - tau * kRate).toRotationMatrix()) /
                           (2 * tau);
    // Central difference: tau² of truncation, ε/tau of rounding.
    EXPECT_LE((left_jacobian(theta) * kRate - axial(R_dot * R.transpose())).norm(), 1e-9) << size;
  }
}

TEST(Rotation, LeftJacobianIsSmoothAcrossItsSeries) {
  const Vector3d axis = kTheta.normalized();
  const Matrix3d below = left_jacobian(0.9999999e-3 * axis);
  const Matrix3d above = left_jacobian(1.0000001e-3 * axis);
  // Cancellation of 1 − cos a and a − sin a at a = 1e-3: 1e-10 of terms that are multiplied by a.
  EXPECT_LE((above - below).norm(), 3e-10);
}

TEST(Rotation, LeftJacobianRateIsTheAngularAccelerationOfUniformRates) {
  const auto angular_velocity = [](double t) -> Vector3d {
    return left_jacobian(kTheta + t * kRate) * kRate;
  };
  const double tau = 1e-4;
  const Vector3d expected = (-angular_velocity(2 * tau) + 8 * angular_velocity(tau) -
                             8 * angular_velocity(-tau) + angular_velocity(-2 * tau)) /
                            (12 * tau);
  // The implementation promises 1e-9 of |θ||θ̇|², here 5.
  EXPECT_LE((left_jacobian_rate(kTheta, kRate) - expected).norm(), 1e-8);
  EXPECT_EQ(left_jacobian_rate(kTheta, Vector3d::Zero()), Vector3d::Zero());
}

TEST(Rotation, BetweenDirectionsIsTheShortest) {
  const Eigen::Vector3d a(1, 2, -0.5), b(-0.3, 4, 2), across = a.cross(b).normalized();
  const Eigen::Quaterniond q = rotation_between(a, b);
  EXPECT_LT((q * a.normalized() - b.normalized()).norm(), 1e-15);
  EXPECT_LT((q * across - across).norm(), 1e-15);
  // Opposite directions leave the axis open, but not the angle.
  const Eigen::Quaterniond half = rotation_between(a, -2 * a);
  EXPECT_LT((half * a + a).norm(), 1e-14);
  EXPECT_NEAR(std::abs(half.w()), 0, 1e-15);
}

TEST(Rotation, BetweenNearlyOppositeDirectionsTurnsAcrossBoth) {
  for (const Eigen::Vector3d& from :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(-0.3, 1, 2)}) {
    const Eigen::Vector3d aside = 1e-7 * from.norm() * from.unitOrthogonal();
    for (const Eigen::Vector3d& to : {Eigen::Vector3d(-2 * from), Eigen::Vector3d(aside - from)}) {
      const Eigen::Quaterniond q = rotation_between(from, to);
      EXPECT_NEAR(q.norm(), 1, 1e-15);
      EXPECT_NEAR(q.vec().dot(from.normalized()), 0, 1e-15);
      EXPECT_NEAR(q.vec().dot(to.normalized()), 0, 1e-15);
      // The angle follows from a cosine, whose last digit is worth 1e-16 / 1e-7 there.
      EXPECT_LT((q * from.normalized() - to.normalized()).norm(), 1e-8) << from.transpose();
    }
  }
}

TEST(Rotation, SpinOfABarHasNoneAboutIt) {
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, 2) / 3, w(3, -1, 0.5);
  const Eigen::Matrix3d J = 0.2 * (Eigen::Matrix3d::Identity() - axis * axis.transpose());
  EXPECT_LT((spin_of(J, J * w) - (w - axis * axis.dot(w))).norm(), 1e-14);
  const Eigen::Matrix3d full = J + 0.01 * axis * axis.transpose();
  EXPECT_LT((spin_of(full, full * w) - w).norm(), 1e-13);
  EXPECT_EQ(spin_of(Eigen::Matrix3d::Zero(), w).norm(), 0);
}

TEST(Rotation, PrincipalAxesDiagonalise) {
  const Eigen::Matrix3d half = left_jacobian(kTheta), A = half * half.transpose();
  const PrincipalAxes axes = principal_axes(A);
  EXPECT_LT((A * axes.vectors - axes.vectors * axes.values.asDiagonal()).norm(), 1e-14 * A.norm());
  EXPECT_LT((principal_values(A) - axes.values).norm(), 1e-14 * A.norm());
  EXPECT_LE(axes.values[0], axes.values[2]);
}

TEST(Pose, ComposesAndInverts) {
  const Pose X_AB{{1, 2, 3}, exp_rotation(kTheta)};
  const Pose X_BC{{-0.4, 0.1, 0.7}, exp_rotation(kRate)};
  const Vector3d p_C(0.3, -0.2, 0.9);
  EXPECT_LE((X_AB * X_BC * p_C - X_AB * (X_BC * p_C)).norm(), 1e-14);
  EXPECT_LE((X_AB.inverse() * (X_AB * p_C) - p_C).norm(), 1e-14);
  EXPECT_LE(((X_AB * X_AB.inverse()).R() - Matrix3d::Identity()).norm(), 1e-14);
}

}  // namespace
}  // namespace buckens::spatial
