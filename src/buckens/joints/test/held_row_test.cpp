// SPDX-License-Identifier: Apache-2.0
// Welds that hold what they find against differences.
#include "buckens/joints/held_row.h"

#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/spatial/test/marker_path.h"

namespace buckens::joints {
namespace {

using Eigen::Vector3d;
using test::MarkerPath;

TEST(HeldRow, RatesAndAccelerationsAreThoseOfTheResidual) {
  const MarkerPath F = MarkerPath::some(1);
  const MarkerPath M = MarkerPath::some(2);
  Eigen::Matrix<double, 12, 1> V, A;
  V << F.w, F.v, M.w, M.v;
  A << F.alpha, F.a, M.alpha, M.a;
  const Vector3d b = Vector3d(0.6, 0.8, 0);
  const Vector3d c = Vector3d(-0.8, 0.6, 0);
  const Eigen::Matrix3d R_FM = spatial::exp_rotation({0.2, 0.3, -0.4}).toRotationMatrix();
  for (const HeldRow& row : {HeldRow::place(b, {0.1, 0.2, 0.3}), HeldRow::turn(b, c, R_FM)}) {
    std::array<double, 4> found{};
    row.attach(MarkerPath::some(3).at(0), MarkerPath::some(4).at(0), 0, found.data());
    for (const double* states :
         {static_cast<const double*>(nullptr), static_cast<const double*>(found.data())}) {
      const auto g = [&](double t) { return row.evaluate(F.at(t), M.at(t), 0, states).g; };
      const RowValue value = row.evaluate(F.at(0), M.at(0), 0, states);
      // Fourth-order differences over 1e-3 of quantities of one.
      EXPECT_NEAR(value.J.dot(V), test::derivative(g), 1e-8);
      EXPECT_NEAR(value.J.dot(A) + row.bias(F.at(0), M.at(0), {}, {}, 0, states),
                  test::second_derivative(g), 1e-5);
    }
  }
}

TEST(HeldRow, HoldsWhatItFound) {
  const HeldRow place = HeldRow::place(Vector3d::UnitX(), {0.1, 0.2, 0.3});
  const HeldRow turn =
      HeldRow::turn(Vector3d::UnitX(), Vector3d::UnitY(), Eigen::Matrix3d::Identity());
  EXPECT_TRUE(place.is_length());
  EXPECT_FALSE(turn.is_length());
  EXPECT_FALSE(place.turns_second());
  EXPECT_TRUE(turn.turns_second());
  const spatial::MarkerMotion F = MarkerPath::some(1).at(0);
  const spatial::MarkerMotion M = MarkerPath::some(2).at(0);
  for (const HeldRow* row : {&place, &turn}) {
    EXPECT_GT(std::abs(row->evaluate(F, M, 0, nullptr).g), 0.01);
    std::array<double, 4> states{}, after{};
    row->attach(F, M, 0, states.data());
    EXPECT_NEAR(row->evaluate(F, M, 0, states.data()).g, 0, 1e-15);
    row->follow(M, F, 1.0, 0, states.data(), after.data());
    EXPECT_EQ(states, after);
    row->follow(F, M, 0.0, 0, nullptr, after.data());
    EXPECT_EQ(row->evaluate(F, M, 0, after.data()).g, row->evaluate(F, M, 0, nullptr).g);
  }
}

}  // namespace
}  // namespace buckens::joints
