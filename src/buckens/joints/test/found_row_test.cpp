// SPDX-License-Identifier: Apache-2.0
// Rows that mesh where they are attached, against the rows themselves and against differences.
#include "buckens/joints/found_row.h"

#include <array>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "buckens/joints/gear_mesh.h"
#include "buckens/spatial/test/marker_path.h"

namespace buckens::joints {
namespace {

using Eigen::Vector3d;
using test::MarkerPath;

constexpr double kPitch = 0.02;

ConstraintRow some_screw() {
  return ConstraintRow::screw(Vector3d::UnitZ(), Vector3d::UnitX(), Vector3d::UnitX(), 0.1, kPitch);
}

ConstraintRow some_belt() {
  GearMesh::Data data;
  data.r_F = {0.3, 0.4, 0};
  data.sizes = {0.1, 0.05};
  data.same_sense = true;
  data.has_teeth = false;
  return ConstraintRow::by_law(std::make_shared<GearMesh>(data));
}

TEST(FoundRow, IsTheRowItselfAsPlaced) {
  const spatial::MarkerMotion F = MarkerPath::some(1).at(0);
  const spatial::MarkerMotion M = MarkerPath::some(2).at(0);
  for (const ConstraintRow& own : {some_screw(), some_belt()}) {
    const FoundRow row(own);
    EXPECT_EQ(row.num_states(), own.num_states() + 1);
    EXPECT_EQ(row.is_length(), own.is_length());
    EXPECT_EQ(row.turns_second(), own.turns_second());
    EXPECT_EQ(row.evaluate(F, M, 0, nullptr).g, own.evaluate(F, M, 0).g);
    EXPECT_EQ(row.evaluate(F, M, 0, nullptr).J, own.evaluate(F, M, 0).J);
  }
}

TEST(FoundRow, IsClosedWhereItWasAttachedAndMovesAsBefore) {
  const MarkerPath F = MarkerPath::some(1);
  const MarkerPath M = MarkerPath::some(2);
  Eigen::Matrix<double, 12, 1> V, A;
  V << F.w, F.v, M.w, M.v;
  A << F.alpha, F.a, M.alpha, M.a;
  const FoundRow row(some_belt());
  std::array<double, 1 + GearMesh::kStates> states{}, after{};
  row.attach(F.at(0), M.at(0), 0, states.data());
  EXPECT_GT(std::abs(states[0]), 1e-3);
  EXPECT_NEAR(row.evaluate(F.at(0), M.at(0), 0, states.data()).g, 0, 1e-15);
  row.follow(F.at(0), M.at(0), 1.0, 0, states.data(), after.data());
  EXPECT_EQ(after[0], states[0]);
  const auto g = [&](double t) { return row.evaluate(F.at(t), M.at(t), 0, states.data()).g; };
  const RowValue value = row.evaluate(F.at(0), M.at(0), 0, states.data());
  // Fourth-order differences over 1e-3 of quantities of one.
  EXPECT_NEAR(value.J.dot(V), test::derivative(g), 1e-8);
  EXPECT_NEAR(value.J.dot(A) + row.bias(F.at(0), M.at(0), {}, {}, 0, states.data()),
              test::second_derivative(g), 1e-5);
}

TEST(FoundRow, ANutStaysClosedAcrossTheEndOfItsPitch) {
  // Attached 0.49 of a turn off, where the residual itself is about to jump by a pitch.
  const FoundRow row(some_screw(), kPitch);
  spatial::MarkerMotion F, M;
  F.R.setIdentity();
  M.R.setIdentity();
  F.p.setZero();
  M.p = {0, 0, 0.1 + 0.49 * kPitch};
  std::array<double, 1> states{};
  row.attach(F, M, 0, states.data());
  for (const double moved : {0.0, 0.02, 0.3, -0.3}) {
    M.p.z() = 0.1 + (0.49 + moved) * kPitch;
    EXPECT_NEAR(row.evaluate(F, M, 0, states.data()).g, moved * kPitch, 1e-15);
  }
}

}  // namespace
}  // namespace buckens::joints
