// SPDX-License-Identifier: Apache-2.0
// Rows of gears, belts and racks against differences, and what their multipliers do.
#include "buckens/joints/gear_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/spatial/test/marker_path.h"

namespace buckens::joints {
namespace {

using Eigen::Vector3d;
using test::MarkerPath;

const MarkerPath kFirstWheel = MarkerPath::some(1);
const MarkerPath kSecondWheel = MarkerPath::some(2);
// Involutes are steep near their base circles: truncation h⁴ times fifth derivatives is 2e-10.
constexpr double kSmallStep = 2e-4;

struct MeshCase {
  const char* name;
  std::shared_ptr<const RowLaw> law;
  std::vector<double> states;  // with the flank, if any, at the end
};

/// Wheels in general position, on either flank, as no bearing would let them.
std::vector<MeshCase> all_meshes() {
  const Vector3d axis = Vector3d(0.2, -0.7, 0.4).normalized();
  GearMesh::Data gear;
  gear.axis_F = axis;
  gear.r_F = kFirstWheel.at(0).R.transpose() * (kSecondWheel.at(0).p - kFirstWheel.at(0).p);
  gear.R_FM = kFirstWheel.at(0).R.transpose() * kSecondWheel.at(0).R;
  gear.sizes = {13, 41};
  gear.pressure_angle = 0.35;
  gear.helix_angle = 0.2;
  GearMesh::Data ring = gear;
  ring.same_sense = true;
  GearMesh::Data belt = ring;
  belt.has_teeth = false;
  belt.sizes = {0.05, 0.12};
  RackMesh::Data rack;
  rack.axis_F = axis;
  rack.along_F = axis.unitOrthogonal();
  rack.r_F = gear.r_F;
  rack.R_FM = gear.R_FM;
  rack.radius = 0.3;
  rack.pressure_angle = 0.35;
  rack.helix_angle = -0.1;
  return {{"gear", std::make_shared<GearMesh>(gear), {2, 0.1, 0, -3, 0.2, 0, 0, 1}},
          {"ring", std::make_shared<GearMesh>(ring), {0, 0, 0, 0, 0, 0, 0, -1}},
          {"belt", std::make_shared<GearMesh>(belt), {0, 0, 0, 0, 0, 0, 0, 1}},
          {"rack", std::make_shared<RackMesh>(rack), {5, 0, 0, 0, -1}}};
}

Eigen::Matrix<double, 12, 1> stacked(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                                     const Vector3d& d) {
  Eigen::Matrix<double, 12, 1> out;
  out << a, b, c, d;
  return out;
}

TEST(GearMesh, RatesAndAccelerationsAreThoseOfTheResidual) {
  for (const auto& [name, law, states] : all_meshes()) {
    const auto g = [&, &row = *law, &known = states](double t) {
      return row.evaluate(kFirstWheel.at(t), kSecondWheel.at(t), 0, known.data()).g;
    };
    const RowValue value = law->evaluate(kFirstWheel.at(0), kSecondWheel.at(0), 0, states.data());
    EXPECT_NEAR(value.J.dot(stacked(kFirstWheel.w, kFirstWheel.v, kSecondWheel.w, kSecondWheel.v)),
                test::derivative(g, kSmallStep), 1e-9)
        << name;
    const double bias = law->bias(kFirstWheel.at(0), kSecondWheel.at(0), {}, {}, 0, states.data());
    const double acceleration =
        value.J.dot(stacked(kFirstWheel.alpha, kFirstWheel.a, kSecondWheel.alpha, kSecondWheel.a)) +
        bias;
    // Rounding ε/h².
    EXPECT_NEAR(acceleration, test::second_derivative(g, kSmallStep), 1e-6) << name;
    EXPECT_NEAR(law->bias(kFirstWheel.at(0), kSecondWheel.at(0), {kFirstWheel.alpha, kFirstWheel.a},
                          {kSecondWheel.alpha, kSecondWheel.a}, 0, states.data()),
                acceleration, 1e-12 * std::abs(acceleration))
        << name;
  }
}

TEST(GearMesh, JacobianEntriesAreDerivativesByEachTwistComponent) {
  for (const auto& [name, law, states] : all_meshes()) {
    const RowValue value = law->evaluate(kFirstWheel.at(0), kSecondWheel.at(0), 0, states.data());
    for (int k = 0; k < 12; ++k) {
      MarkerPath F = kFirstWheel;
      MarkerPath M = kSecondWheel;
      for (MarkerPath* path : {&F, &M})
        path->v = path->a = path->w = path->alpha = Vector3d::Zero();
      MarkerPath& moving = k < 6 ? F : M;
      (k % 6 < 3 ? moving.w : moving.v)[k % 3] = 1.0;
      const double expected = test::derivative(
          [&, &row = *law, &known = states](double t) {
            return row.evaluate(F.at(t), M.at(t), 0, known.data()).g;
          },
          kSmallStep);
      EXPECT_NEAR(value.J[k], expected, 1e-9) << name << ", component " << k;
    }
  }
}

/// Two gears with axes along z, centres on x; the second one's place may be moved.
struct GearPair {
  GearMesh::Data data;
  explicit GearPair(bool ring) {
    data.r_F = {0.06, 0, 0};
    data.sizes = {20, ring ? 60.0 : 40.0};
    data.same_sense = ring;
    data.pressure_angle = 20 * std::numbers::pi / 180;
  }
  spatial::MarkerMotion at(const Vector3d& p, double angle) const {
    spatial::MarkerMotion out;
    out.p = p;
    out.R = Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix();
    return out;
  }
};

TEST(GearMesh, TeethPushGearsApartWhicheverFlankCarries) {
  for (const bool ring : {false, true}) {
    const GearPair pair(ring);
    const GearMesh law(pair.data);
    const spatial::MarkerMotion F = pair.at({0, 0, 0}, 0), M = pair.at({0.06, 0, 0}, 0);
    for (const double lambda : {3.0, -3.0}) {
      std::array<double, GearMesh::kStates> states{};
      law.follow(F, M, lambda, 0, nullptr, states.data());
      const Vector3d force =
          lambda * law.evaluate(F, M, 0, states.data()).J.segment<3>(9).transpose();
      // Line of action at 20 degrees against the tangent; a gear in a ring is pushed inwards.
      EXPECT_NEAR(force.x(), (ring ? -3.0 : 3.0) * std::sin(pair.data.pressure_angle), 1e-14);
      EXPECT_NEAR(std::abs(force.y()), 3.0 * std::cos(pair.data.pressure_angle), 1e-14);
    }
  }
}

TEST(GearMesh, InvolutesKeepTheirRatioWhenCentresMoveApart) {
  // Along a path on which the row holds, angles against the line of centres keep their ratio
  // whatever the distance is, as long as it stays the same.
  const GearPair pair(false);
  const GearMesh law(pair.data);
  const std::array<double, GearMesh::kStates> states{0, 0, 0, 0, 0, 0, 0, 1};
  const auto g = [&](double distance, double angle) {
    return law
        .evaluate(pair.at({0, 0, 0}, angle), pair.at({distance, 0, 0}, -0.5 * angle), 0,
                  states.data())
        .g;
  };
  EXPECT_NEAR(g(0.0605, 0.4), g(0.0605, -0.7), 1e-16);
  // And centres that move apart by little open the flanks by sin α of it.
  EXPECT_NEAR((g(0.06 + 1e-6, 0) - g(0.06 - 1e-6, 0)) / 2e-6, std::sin(pair.data.pressure_angle),
              1e-8);
}

/// Wheels of a gear, ring or belt that turn at constant speeds about fixed centres, and the row's
/// residual there, followed by steps of h.
double residual_after_steps(const GearPair& pair, double speed, double h, int steps) {
  const GearMesh law(pair.data);
  const double ratio = pair.data.sizes[0] / pair.data.sizes[1];
  const auto wheel = [&](double x, double rate, double t) {
    spatial::MarkerMotion out = pair.at({x, 0, 0}, std::remainder(rate * t, kTurn));
    out.w = {0, 0, rate};
    return out;
  };
  const double other = (pair.data.same_sense ? ratio : -ratio) * speed;
  std::array<double, GearMesh::kStates> states{};
  law.follow(wheel(0, speed, 0), wheel(0.06, other, 0), 0.0, 0.0, nullptr, states.data());
  double largest = 0;
  for (int k = 1; k <= steps; ++k) {
    // Within the step and at its end, as a step evaluates it.
    for (const double t : {(k - 0.5) * h, k * h}) {
      const auto F = wheel(0, speed, t), M = wheel(0.06, other, t);
      largest = std::max(largest, std::abs(law.evaluate(F, M, t, states.data()).g));
    }
    law.follow(wheel(0, speed, k * h), wheel(0.06, other, k * h), 0.0, k * h, states.data(),
               states.data());
  }
  return largest;
}

TEST(GearMesh, IsFollowedOverSeveralTurnsInAStep) {
  GearPair belt(true);
  belt.data.has_teeth = false;
  belt.data.sizes = {0.017, 0.029};  // no turns of one are turns of the other
  for (const GearPair& pair : {GearPair(false), GearPair(true), belt}) {
    // 10 to 20 rad in a step. Angles are taken at 2000 rad: rounding of 2e-13 rad.
    EXPECT_LT(residual_after_steps(pair, 1e4, 1e-3, 200), 1e-13);
    EXPECT_LT(residual_after_steps(pair, -2e4, 1e-3, 100), 1e-13);
  }
}

TEST(GearMesh, SaysWhereASpeedChangesTooMuchInAStep) {
  const GearPair pair(false);
  const GearMesh law(pair.data);
  std::array<double, GearMesh::kStates> states{};
  spatial::MarkerMotion F = pair.at({0, 0, 0}, 0);
  const spatial::MarkerMotion M = pair.at({0.06, 0, 0}, 0);
  law.follow(F, M, 0, 0, nullptr, states.data());
  F.w = {0, 0, 3.1};
  EXPECT_NO_THROW(law.follow(F, M, 0, 1.0, states.data(), states.data()));
  F.w = {0, 0, 6.3};
  EXPECT_THROW(law.follow(F, M, 0, 2.0, states.data(), states.data()), StepTooLong);
}

TEST(RackMesh, IsFollowedOverSeveralTurnsInAStep) {
  RackMesh::Data data;
  data.radius = 0.02;
  const RackMesh law(data);
  std::array<double, RackMesh::kStates> states{};
  constexpr double kSpeed = 9000, kStep = 1e-3;
  const auto pinion = [&](double t) {
    spatial::MarkerMotion out;
    out.p = {data.radius * kSpeed * t, 0, 0};
    out.R = Eigen::AngleAxisd(kSpeed * t, Vector3d::UnitZ()).toRotationMatrix();
    out.w = {0, 0, kSpeed};
    return out;
  };
  law.follow({}, pinion(0), 0, 0, nullptr, states.data());
  for (int k = 1; k <= 100; ++k) {
    const double t = k * kStep;
    EXPECT_NEAR(law.evaluate({}, pinion(t), t, states.data()).g, 0, 1e-13) << k;
    law.follow({}, pinion(t), 0, t, states.data(), states.data());
  }
}

TEST(TurnSum, LosesNoDigitsOverTurns) {
  TurnSum sum;
  sum.add(13, {41000000, 0.5});
  sum.add(-41, {13000000, 0.25});
  EXPECT_EQ(sum.value(), 13 * 0.5 - 41 * 0.25);
  // Factors without an exact sum: what is left counts as an angle, with all its digits.
  TurnSum other;
  other.add(0.1, {1000001, 0.0});
  other.add(-0.3, {333333, 0.0});
  // As doubles, 0.1 is 5.55e-18 too large and 0.3 by 1.11e-17 too small.
  const double beyond = 1000001 * 5.5511151231257827e-18 + 333333 * 1.1102230246251565e-17;
  EXPECT_NEAR(other.value(), 2 * std::numbers::pi * (0.2 + beyond), 1e-15);
}

}  // namespace
}  // namespace buckens::joints
