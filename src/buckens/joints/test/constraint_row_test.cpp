// SPDX-License-Identifier: Apache-2.0
#include "buckens/joints/constraint_row.h"

#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/spatial/test/marker_path.h"

namespace buckens::joints {
namespace {

using Eigen::Vector3d;
using test::MarkerPath;

base::TimeLaw some_law() {
  return base::TimeLaw::expression(base::Expression("0.3*sin(2*t+1)+0.4*t", {"t"}, {}, {}));
}

/// One row of each kind with general vectors.
std::vector<std::pair<const char*, ConstraintRow>> all_rows() {
  const Vector3d e = Vector3d(0.2, -0.7, 0.4).normalized();
  const Vector3d c = Vector3d(-0.5, 0.3, 0.6).normalized();
  const Vector3d x = e.unitOrthogonal();
  return {{"point_world", ConstraintRow::point_world(e)},
          {"point_along", ConstraintRow::point_along(e)},
          {"point_along with law", ConstraintRow::point_along(e, 0.3, some_law())},
          {"direction", ConstraintRow::direction(e, c)},
          {"turning", ConstraintRow::turning(e, x, c, some_law())},
          {"distance", ConstraintRow::distance(0.7)},
          {"homokinetic", ConstraintRow::homokinetic(x, e.cross(x), c, c.unitOrthogonal())}};
}

Eigen::Matrix<double, 12, 1> stack(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                                   const Vector3d& d) {
  Eigen::Matrix<double, 12, 1> out;
  out << a, b, c, d;
  return out;
}

const MarkerPath kF = MarkerPath::some(1);
const MarkerPath kM = MarkerPath::some(2);
constexpr double kTime = 0.37;

TEST(ConstraintRow, RateIsThatOfTheResidual) {
  for (const auto& [name, row] : all_rows()) {
    const RowValue value = row.evaluate(kF.at(0), kM.at(0), kTime);
    const double expected = test::derivative([&, &constraint = row](double t) {
      return constraint.evaluate(kF.at(t), kM.at(t), kTime + t).g;
    });
    const double rate = value.J.dot(stack(kF.w, kF.v, kM.w, kM.v)) + value.g_t;
    EXPECT_NEAR(rate, expected, 1e-10) << name;  // truncation h⁴ times fifth derivatives
  }
}

TEST(ConstraintRow, PartialTimeDerivativeComesFromTheLawAlone) {
  for (const auto& [name, row] : all_rows()) {
    const double expected = test::derivative([&, &constraint = row](double t) {
      return constraint.evaluate(kF.at(0), kM.at(0), kTime + t).g;
    });
    EXPECT_NEAR(row.evaluate(kF.at(0), kM.at(0), kTime).g_t, expected, 1e-10) << name;
    EXPECT_EQ(row.depends_on_time(), expected != 0.0) << name;
  }
}

TEST(ConstraintRow, JacobianEntriesAreDerivativesByEachTwistComponent) {
  for (const auto& [name, row] : all_rows()) {
    const RowValue value = row.evaluate(kF.at(0), kM.at(0), kTime);
    for (int k = 0; k < 12; ++k) {
      MarkerPath F = kF;
      MarkerPath M = kM;
      for (MarkerPath* path : {&F, &M})
        path->v = path->a = path->w = path->alpha = Vector3d::Zero();
      MarkerPath& moving = k < 6 ? F : M;
      (k % 6 < 3 ? moving.w : moving.v)[k % 3] = 1.0;
      const double expected = test::derivative([&, &constraint = row](double t) {
        return constraint.evaluate(F.at(t), M.at(t), kTime).g;
      });
      EXPECT_NEAR(value.J[k], expected, 1e-10) << name << ", component " << k;
    }
  }
}

TEST(ConstraintRow, AccelerationIsJacobianTimesAccelerationAndBias) {
  for (const auto& [name, row] : all_rows()) {
    const RowValue value = row.evaluate(kF.at(0), kM.at(0), kTime);
    const double expected = test::second_derivative([&, &constraint = row](double t) {
      return constraint.evaluate(kF.at(t), kM.at(t), kTime + t).g;
    });
    const double bias = row.bias(kF.at(0), kM.at(0), {}, {}, kTime);
    const double acceleration = value.J.dot(stack(kF.alpha, kF.a, kM.alpha, kM.a)) + bias;
    // Truncation h⁴, rounding ε/h².
    EXPECT_NEAR(acceleration, expected, 1e-8) << name;
    // Accelerations that do not come from coordinates enter the same way.
    const double all = row.bias(kF.at(0), kM.at(0), {kF.alpha, kF.a}, {kM.alpha, kM.a}, kTime);
    EXPECT_NEAR(all, acceleration, 1e-12) << name;
  }
}

TEST(ConstraintRow, OnlyPointsAreLengths) {
  for (const auto& [name, row] : all_rows()) {
    const bool is_length =
        std::string(name).rfind("point", 0) == 0 || std::string(name) == "distance";
    EXPECT_EQ(row.is_length(), is_length) << name;
  }
}

/// M turns about an axis of F and slides along it, F moves as it likes: a screw's other rows hold.
struct OnAxis {
  Vector3d axis_F = Vector3d(0.2, -0.7, 0.4).normalized();
  double angle(double t) const { return 0.4 + 1.3 * t - 0.8 * t * t; }
  double slide(double t) const { return 0.2 - 0.6 * t + 0.5 * t * t; }
  spatial::MarkerMotion at(double t) const {
    const spatial::MarkerMotion F = kF.at(t);
    spatial::MarkerMotion M;
    const Vector3d axis = F.R * axis_F;
    M.R = Eigen::AngleAxisd(angle(t), axis).toRotationMatrix() * F.R;
    M.p = F.p + slide(t) * axis;
    M.w = F.w + (1.3 - 1.6 * t) * axis;
    M.v = F.v + F.w.cross(M.p - F.p) + (-0.6 + t) * axis;
    return M;
  }
};

TEST(ConstraintRow, ScrewFollowsAngleAndDisplacementOverTurns) {
  const OnAxis M;
  const Vector3d x = M.axis_F.unitOrthogonal();
  for (const double pitch : {0.05, -0.3}) {
    const auto row = ConstraintRow::screw(M.axis_F, x, x, 0.0, pitch);
    EXPECT_TRUE(row.is_length() && row.turns_first() && row.turns_second());
    const auto open = [&](double t) {
      return M.slide(t) - pitch * M.angle(t) / (2.0 * std::numbers::pi);
    };
    // Whole turns are determined by the displacement: the residual is the remainder.
    EXPECT_NEAR(row.evaluate(kF.at(0), M.at(0), 0).g, open(0) - pitch * std::round(open(0) / pitch),
                1e-14);
    const RowValue value = row.evaluate(kF.at(0), M.at(0), 0);
    const double rate = value.J.dot(stack(kF.w, kF.v, M.at(0).w, M.at(0).v));
    EXPECT_NEAR(rate, test::derivative([&](double t) { return open(t); }), 1e-10);
    EXPECT_NEAR(rate,
                test::derivative([&](double t) { return row.evaluate(kF.at(t), M.at(t), 0).g; }),
                1e-10);
    // Along the joint's own motion: M's acceleration is that of its rate.
    const Vector3d alpha = test::derivative([&](double t) { return M.at(t).w; });
    const Vector3d a = test::derivative([&](double t) { return M.at(t).v; });
    const double acceleration =
        value.J.dot(stack(kF.alpha, kF.a, alpha, a)) + row.bias(kF.at(0), M.at(0), {}, {}, 0);
    EXPECT_NEAR(acceleration, test::second_derivative([&](double t) { return open(t); }), 1e-7);
  }
}

}  // namespace
}  // namespace buckens::joints
