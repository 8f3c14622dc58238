// SPDX-License-Identifier: Apache-2.0
// Two rigid rods fall from the horizontal; see README.md.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "buckens/base/test/source_directory.h"
#include "buckens/dynamics/test/example_models.h"
#include "buckens/stepping/test/simulate.h"

namespace buckens::verification::rigid_double_pendulum {
namespace {

using Eigen::Vector3d;
using stepping::Method;

/// θ1, θ2 from the downward vertical [rad] and their rates at t = 1 s.
Eigen::Vector4d reference() {
  std::ifstream file(std::string(buckens::test::kSourceDirectory) +
                     "/verification/rigid_double_pendulum/reference.json");
  const auto json = nlohmann::json::parse(file);
  const auto& row = json["theta1_theta2_w1_w2"][2];
  EXPECT_EQ(json["t"][2].get<double>(), 1.0);
  Eigen::Vector4d out;
  for (Eigen::Index k = 0; k < 4; ++k) out[k] = row[static_cast<std::size_t>(k)].get<double>();
  return out;
}

double angle(const model::BodyState& rod) {
  const Vector3d x = rod.frame.X_WB.q * Vector3d::UnitX();
  return std::atan2(x.x(), -x.y());
}

struct Errors {
  double angle, rate;
};

Errors errors(const model::State& state) {
  const Eigen::Vector4d exact = reference();
  const auto& b = state.bodies;
  return {std::max(std::abs(angle(b[0]) - exact[0]), std::abs(angle(b[1]) - exact[1])),
          std::max(std::abs(b[0].frame.w.z() - exact[2]), std::abs(b[1].frame.w.z() - exact[3]))};
}

class RigidDoublePendulum : public testing::TestWithParam<Method> {};

TEST_P(RigidDoublePendulum, ErrorsFallWithTheSquareOfTheStep) {
  for (const bool planar : {true, false}) {
    const model::Model model = test::rigid_double_pendulum(planar);
    const test::Start start = test::consistent_start(model);
    EXPECT_EQ(start.rows_in_use.size(), planar ? 4U : 10U);
    const Errors coarse = errors(simulate(model, start, test::settings(GetParam(), 1e-3), 1.0));
    const Errors fine = errors(simulate(model, start, test::settings(GetParam(), 5e-4), 1.0));
    // Terms of fourth order are about 1 % at these steps.
    EXPECT_NEAR(test::observed_order(coarse.angle, fine.angle), 2.0, 0.02);
    EXPECT_NEAR(test::observed_order(coarse.rate, fine.rate), 2.0, 0.02);
  }
}

TEST_P(RigidDoublePendulum, FineStepsReachAMillionthRadian) {
  const model::Model model = test::rigid_double_pendulum(true);
  const test::Start start = test::consistent_start(model);
  const double h = GetParam() == Method::newmark ? 2.5e-4 : 1.25e-4;
  const Errors error = errors(simulate(model, start, test::settings(GetParam(), h), 1.0));
  EXPECT_LT(error.angle, 1e-6);
  RecordProperty("angle_error", std::to_string(error.angle * 1e9) + " nrad");
}

INSTANTIATE_TEST_SUITE_P(Methods, RigidDoublePendulum,
                         testing::Values(Method::generalized_alpha, Method::newmark, Method::hht),
                         [](const auto& method) {
                           std::string name = stepping::to_string(method.param);
                           name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
                           return name;
                         });

TEST(RigidDoublePendulumMultipliers, ConvergeWithOrderTwoAtTheDefaultMethod) {
  const model::Model model = test::rigid_double_pendulum(true);
  const test::Start start = test::consistent_start(model);
  std::vector<linalg::Vector> lambda;
  for (const double h : {1e-3, 5e-4, 2.5e-4}) {
    const auto settings = test::settings(Method::generalized_alpha, h);
    const model::State end = simulate(model, start, settings, 1.0);
    EXPECT_NEAR(end.lambda_time, 1.0, 1e-12);
    lambda.push_back(end.lambda);
  }
  const double order =
      test::observed_order((lambda[0] - lambda[1]).norm(), (lambda[1] - lambda[2]).norm());
  EXPECT_NEAR(order, 2.0, 0.02);
}

}  // namespace
}  // namespace buckens::verification::rigid_double_pendulum
