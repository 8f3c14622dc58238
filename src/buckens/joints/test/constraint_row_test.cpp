// SPDX-License-Identifier: Apache-2.0
#include "buckens/joints/constraint_row.h"

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
          {"turning", ConstraintRow::turning(e, x, c, some_law())}};
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
    EXPECT_EQ(row.is_length(), std::string(name).rfind("point", 0) == 0) << name;
  }
}

}  // namespace
}  // namespace buckens::joints
