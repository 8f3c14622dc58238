// SPDX-License-Identifier: Apache-2.0
#include "buckens/joints/joint.h"

#include <cmath>
#include <optional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/spatial/rotation.h"

namespace buckens::joints {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using spatial::MarkerMotion;
using testing::HasSubstr;

/// Markers in general orientation, sharing their origin.
struct Placed {
  MarkerMotion F, M;
  Placement placement;
  Vector3d axis_W;
};

Placed placed(JointType type) {
  Placed out;
  out.F.p = out.M.p = Vector3d(0.4, -0.3, 1.2);
  out.F.R = spatial::exp_rotation({0.6, -0.4, 1.3}).toRotationMatrix();
  out.M.R = spatial::exp_rotation({-1.0, 0.2, 0.5}).toRotationMatrix();
  out.placement.R_WF = out.F.R;
  out.placement.R_WM = out.M.R;
  out.placement.axis_F = Vector3d(0.3, 2.0, -0.7);
  out.axis_W = out.F.R * out.placement.axis_F.normalized();
  if (type == JointType::prescribed_rotation || type == JointType::prescribed_translation) {
    out.placement.law = base::TimeLaw::expression(base::Expression("0.7*t", {"t"}, {}, {}));
  }
  return out;
}

double largest_residual(const std::vector<ConstraintRow>& rows, const Placed& p, double t) {
  double out = 0;
  for (const ConstraintRow& row : rows) {
    out = std::max(out, std::abs(row.evaluate(p.F, p.M, t).g));
  }
  return out;
}

MarkerMotion turned(MarkerMotion M, const Vector3d& psi_W) {
  M.R = spatial::exp_rotation(psi_W).toRotationMatrix() * M.R;
  return M;
}

constexpr JointType kAll[] = {
    JointType::revolute, JointType::spherical,           JointType::prismatic,
    JointType::fixed,    JointType::prescribed_rotation, JointType::prescribed_translation};

TEST(Joint, IsClosedAsPlaced) {
  for (const JointType type : kAll) {
    const Placed p = placed(type);
    EXPECT_LE(largest_residual(make_rows(type, p.placement), p, 0.0), 1e-15) << to_string(type);
  }
}

TEST(Joint, HasTheRowsOfItsKind) {
  const int in_space[] = {5, 3, 5, 6, 1, 1};
  const int in_plane[] = {2, 2, 2, 3, 1, 1};
  for (std::size_t k = 0; k < std::size(kAll); ++k) {
    Placed p = placed(kAll[k]);
    EXPECT_EQ(make_rows(kAll[k], p.placement).size(), in_space[k]) << to_string(kAll[k]);
    p.placement.planar = spatial::Plane::xy;
    const bool slides =
        kAll[k] == JointType::prismatic || kAll[k] == JointType::prescribed_translation;
    p.placement.R_WF = spatial::exp_rotation({0, 0, 0.4}).toRotationMatrix();
    p.placement.axis_F = slides ? Vector3d(1, 0.5, 0) : Vector3d(0, 0, 1);
    EXPECT_EQ(make_rows(kAll[k], p.placement).size(), in_plane[k]) << to_string(kAll[k]);
  }
}

TEST(Joint, AWeldInThePlaneHoldsWhateverTheAxesOfItsMarkers) {
  for (const double angle : {0.0, 0.3, 0.8, 1.2, 1.6}) {
    Placed p = placed(JointType::fixed);
    p.placement.planar = spatial::Plane::xy;
    p.F.R = p.placement.R_WF =
        spatial::exp_rotation(angle * Vector3d(0.6, 0.8, 0)).toRotationMatrix();
    p.placement.axis_F = Vector3d::UnitZ();
    const auto rows = make_rows(JointType::fixed, p.placement);
    EXPECT_EQ(rows.size(), 3U) << angle;
    EXPECT_LE(largest_residual(rows, p, 0.0), 1e-15) << angle;
    p.M = turned(p.M, Vector3d(0, 0, 0.1));
    EXPECT_NEAR(largest_residual(rows, p, 0.0), std::sin(0.1), 1e-15) << angle;
  }
}

TEST(Joint, AllowsItsOwnMotionOnly) {
  for (const JointType type : kAll) {
    Placed p = placed(type);
    const auto rows = make_rows(type, p.placement);
    const MarkerMotion M = p.M;
    const bool turns = type == JointType::revolute || type == JointType::prescribed_translation;
    const bool slides = type == JointType::prismatic || type == JointType::prescribed_rotation;
    p.M = turned(M, 0.5 * p.axis_W);
    EXPECT_EQ(largest_residual(rows, p, 0.0) < 1e-14, turns || type == JointType::spherical)
        << to_string(type);
    p.M = M;
    p.M.p += 0.5 * p.axis_W;
    EXPECT_EQ(largest_residual(rows, p, 0.0) < 1e-14, slides) << to_string(type);
    p.M = turned(M, 0.5 * p.axis_W.unitOrthogonal());
    const bool any_turn = type == JointType::spherical || type == JointType::prescribed_translation;
    if (type != JointType::prescribed_rotation) {
      EXPECT_EQ(largest_residual(rows, p, 0.0) < 1e-14, any_turn) << to_string(type);
    }
  }
}

TEST(Joint, DrivesFollowTheirLaw) {
  const double t = 0.8;
  Placed p = placed(JointType::prescribed_rotation);
  auto rows = make_rows(JointType::prescribed_rotation, p.placement);
  p.M = turned(p.M, 0.7 * t * p.axis_W);
  EXPECT_LE(largest_residual(rows, p, t), 1e-15);
  p = placed(JointType::prescribed_translation);
  // Counted from the initial placement, wherever the markers are.
  p.M.p += Vector3d(0.2, -0.6, 0.3);
  p.placement.r_F = p.F.R.transpose() * (p.M.p - p.F.p);
  rows = make_rows(JointType::prescribed_translation, p.placement);
  p.M.p += 0.7 * t * p.axis_W;
  EXPECT_LE(largest_residual(rows, p, t), 1e-15);
}

std::string message(JointType type, const Placement& placement) {
  try {
    make_rows(type, placement);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Joint, RefusesAnAxisThatDoesNotFit) {
  Placement placement;
  placement.axis_F.setZero();
  EXPECT_THAT(message(JointType::revolute, placement), HasSubstr("no direction"));
  placement.planar = spatial::Plane::xy;
  placement.axis_F << 0, 0.1, 1;
  EXPECT_THAT(message(JointType::revolute, placement), HasSubstr("normal to the plane"));
  EXPECT_THAT(message(JointType::prismatic, placement), HasSubstr("in the plane"));
}

}  // namespace
}  // namespace buckens::joints
