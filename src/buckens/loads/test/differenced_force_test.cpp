// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/differenced_force.h"

#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/base/errors.h"

namespace buckens::loads {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using spatial::MarkerMotion;

MarkerMotion some_motion() {
  MarkerMotion out;
  out.p = {0.3, -1.2, 40.0};
  out.v = {2.0, 0.1, -5.0};
  return out;
}

/// Sums of n nᵀ k and n nᵀ c over the rows.
std::pair<Matrix3d, Matrix3d> resistance_of(const std::vector<SoftRow>& rows) {
  std::pair<Matrix3d, Matrix3d> out(Matrix3d::Zero(), Matrix3d::Zero());
  for (const SoftRow& row : rows) {
    const Vector3d n = row.J.segment<3>(3).transpose();
    EXPECT_EQ(row.J.norm(), n.norm()) << "only the translation of the first marker";
    out.first += row.stiffness * n * n.transpose();
    out.second += row.damping * n * n.transpose();
  }
  return out;
}

TEST(DifferencedForce, GivesTheSymmetricResistanceOfALinearLaw) {
  Matrix3d K, C;
  K << 500, 20, -10, 20, 300, 5, -10, 5, 900;
  C << 8, 1, 0, 1, 4, 0, 0, 0, 2;
  Matrix3d turning;  // an unsymmetric part, which the rows leave out
  turning << 0, 7, 0, -7, 0, 0, 0, 0, 0;
  const DifferencedForce force([&](double t, const MarkerMotion& m) -> Vector3d {
    return t * Vector3d::UnitX() - (K + turning) * m.p - C * m.v;
  });
  const MarkerMotion at = some_motion(), ground;
  std::vector<SoftRow> rows;
  force.append_tangent({2.0, at, ground}, rows);
  ASSERT_EQ(rows.size(), static_cast<std::size_t>(force.num_soft_rows()));
  const auto [stiffness, damping] = resistance_of(rows);
  // Rounding of forces of 4e4 N over increments of 4e-5 m, and of 2e-6 m at the smallest: 1e-5 N/m.
  EXPECT_LT((stiffness - K).norm(), 1e-4);
  EXPECT_LT((damping - C).norm(), 1e-4);
  const Action action = force.evaluate(2.0, at, ground);
  EXPECT_EQ(action.on_first.force, 2.0 * Vector3d::UnitX() - (K + turning) * at.p - C * at.v);
  EXPECT_EQ(action.active_power, action.on_first.force.dot(at.v));
}

TEST(DifferencedForce, LeavesOutWhatDrivesTheMotion) {
  const DifferencedForce force([](double, const MarkerMotion& m) -> Vector3d {
    return {100 * m.p.x(), -50 * m.p.y(), 3 * m.v.z()};
  });
  const MarkerMotion at = some_motion(), ground;
  std::vector<SoftRow> rows;
  force.append_soft_rows(at, ground, rows);
  const auto [stiffness, damping] = resistance_of(rows);
  EXPECT_NEAR(stiffness(0, 0), 0, 1e-9);
  // Rounding of a force of 60 N over an increment of 1e-6 m.
  EXPECT_NEAR(stiffness(1, 1), 50, 1e-6);
  EXPECT_NEAR(damping.norm(), 0, 1e-9);
}

TEST(DifferencedForce, RefusesForcesThatAreNotFinite) {
  const DifferencedForce force([](double, const MarkerMotion&) -> Vector3d {
    return Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  });
  const MarkerMotion at = some_motion(), ground;
  EXPECT_THROW(force.evaluate(0.0, at, ground), NumericalError);
  std::vector<SoftRow> rows;
  force.append_soft_rows(at, ground, rows);  // evaluate() says what is wrong
  EXPECT_EQ(resistance_of(rows).first, Matrix3d::Zero());
}

}  // namespace
}  // namespace buckens::loads
