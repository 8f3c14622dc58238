// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/marker.h"

#include <vector>

#include <gtest/gtest.h>

#include "buckens/body/body.h"
#include "buckens/spatial/test/marker_path.h"

namespace buckens::body {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// A body frame and nodal values that move with constant accelerations.
struct Path {
  Vector3d p{0.4, -0.2, 1.0}, v{0.7, 1.2, -0.5}, a{0.3, -0.9, 0.8};
  Vector3d w{0.9, -0.4, 1.3};  // body axes
  Vector3d alpha{-0.6, 1.1, 0.2};
  Matrix3d R = spatial::exp_rotation({0.3, 0.8, -0.5}).toRotationMatrix();
  VectorXd y, y_dot, y_ddot;

  Path() : y(6), y_dot(6), y_ddot(6) {
    y << 0.1, -0.2, 0.05, 0.3, -0.1, 0.2;
    y_dot << -0.5, 0.3, 0.8, 0.7, -0.9, 0.4;
    y_ddot << 0.9, 0.2, -0.4, -0.3, 0.6, 1.1;
  }

  MarkerKinematics at(const Marker& marker, double t) const {
    FrameMotion frame;
    // R(t) = R exp(ψ~): the angular velocity in body axes is that of the reverse path's outer axes.
    const Vector3d psi = t * w + 0.5 * t * t * alpha;
    frame.X_WB.p = p + t * v + 0.5 * t * t * a;
    frame.X_WB.q = Eigen::Quaterniond(R) * spatial::exp_rotation(psi);
    frame.w = spatial::left_jacobian(-psi) * (w + t * alpha);
    frame.v = v + t * a;
    return marker_kinematics(marker, frame, y + t * y_dot + 0.5 * t * t * y_ddot,
                             y_dot + t * y_ddot);
  }
};

std::vector<Marker> markers() {
  Marker rigid;
  rigid.X_BF = {{0.5, 0.2, -0.3}, spatial::exp_rotation({0.2, 0.9, 0.1})};
  Marker node = rigid;
  node.translation_row = 0;
  node.rotation_row = 3;
  Marker point = rigid;
  point.translation_row = 0;
  return {rigid, node, point};
}

Vector3d axial(const Matrix3d& A) {
  return 0.5 * Vector3d(A(2, 1) - A(1, 2), A(0, 2) - A(2, 0), A(1, 0) - A(0, 1));
}

TEST(Marker, VelocitiesAreRatesOfItsPose) {
  const Path path;
  for (const Marker& marker : markers()) {
    const auto motion = path.at(marker, 0).motion;
    const Vector3d v = test::derivative([&](double t) { return path.at(marker, t).motion.p; });
    const Matrix3d R_dot = test::derivative([&](double t) { return path.at(marker, t).motion.R; });
    EXPECT_LE((motion.v - v).norm(), 1e-10);
    EXPECT_LE((motion.w - axial(R_dot * motion.R.transpose())).norm(), 1e-10);
  }
}

TEST(Marker, BiasIsWhatCoordinateAccelerationsLeave) {
  Path path;
  path.a = path.alpha = Vector3d::Zero();
  path.y_ddot.setZero();
  for (const Marker& marker : markers()) {
    FrameMotion frame;
    frame.X_WB = {path.p, Eigen::Quaterniond(path.R)};
    frame.w = path.w;
    frame.v = path.v;
    const auto bias = marker_bias(marker, frame, path.y, path.y_dot);
    const Vector3d a = test::derivative([&](double t) { return path.at(marker, t).motion.v; });
    const Vector3d alpha = test::derivative([&](double t) { return path.at(marker, t).motion.w; });
    EXPECT_LE((bias.a - a).norm(), 1e-9);
    // The rate of the left Jacobian is itself a difference, good to 1e-9.
    EXPECT_LE((bias.alpha - alpha).norm(), 1e-8);
  }
}

TEST(Marker, LoadsDoTheWorkOfTheWrench) {
  const Path path;
  const spatial::Wrench wrench{{0.3, -0.8, 0.6}, {1.2, 0.5, -0.7}};
  for (const Marker& marker : markers()) {
    const MarkerKinematics k = path.at(marker, 0);
    const double power = wrench.torque.dot(k.motion.w) + wrench.force.dot(k.motion.v);
    const auto frame = k.frame_load(wrench);
    const auto interface = k.interface_load(wrench);
    double found = frame.head<3>().dot(path.w) + frame.tail<3>().dot(path.v);
    if (marker.translation_row >= 0) found += interface.head<3>().dot(path.y_dot.head<3>());
    if (marker.rotation_row >= 0) found += interface.tail<3>().dot(path.y_dot.tail<3>());
    EXPECT_NEAR(found, power, 1e-14);
  }
}

TEST(FrameCoordinates, MissingInertiaDropsARotationAndSaysSo) {
  Body rod;
  rod.name = "rod";
  rod.mass = 1.0;
  const Matrix3d R = spatial::exp_rotation({0.1, 0.7, 0.4}).toRotationMatrix();
  rod.J0 = R * Vector3d(0.0, 0.1, 0.1).asDiagonal() * R.transpose();
  select_frame_coordinates(rod, std::nullopt);
  ASSERT_EQ(rod.rotation_basis.cols(), 2);
  EXPECT_LE((rod.rotation_basis.transpose() * R.col(0)).norm(), 1e-12);
  EXPECT_EQ(rod.translation_basis.cols(), 3);
  ASSERT_EQ(rod.missing_rotations.cols(), 1);
  EXPECT_NEAR(std::abs(rod.missing_rotations.col(0).dot(R.col(0))), 1.0, 1e-12);
  EXPECT_NE(missing_inertia_note(rod, R.col(0)).find("\"rod\""), std::string::npos);
}

TEST(FrameCoordinates, PlanarBodiesKeepThree) {
  Body body;
  body.mass = 1.0;
  body.J0 = Vector3d(0.0, 0.0, 0.1).asDiagonal();  // planar data only
  select_frame_coordinates(body, Vector3d::UnitZ());
  EXPECT_EQ(body.rotation_basis.cols(), 1);
  EXPECT_EQ(body.translation_basis.cols(), 2);
  EXPECT_EQ(body.missing_rotations.cols(), 0);
}

}  // namespace
}  // namespace buckens::body
