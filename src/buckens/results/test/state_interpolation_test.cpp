// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/state_interpolation.h"

#include <cmath>

#include <gtest/gtest.h>

#include "buckens/spatial/rotation.h"

namespace buckens::results {
namespace {

using Eigen::Vector3d;

/// A motion that is cubic in time: translation, angle about one axis, one nodal variable.
model::State cubic_motion(double t) {
  const Vector3d a(1, -2, 3), b(0.5, 4, -1), c(-3, 2, 1), axis = Vector3d(1, 2, 2) / 3;
  const auto value = [t](double c0, double c1, double c2, double c3) {
    return c0 + t * (c1 + t * (c2 + t * c3));
  };
  const auto rate = [t](double c1, double c2, double c3) { return c1 + t * (2 * c2 + 3 * t * c3); };
  model::State out;
  out.t = t;
  out.bodies.resize(1);
  model::BodyState& body = out.bodies[0];
  body.frame.X_WB.p = a * t + b * t * t + c * t * t * t;
  body.frame.v = a + 2 * b * t + 3 * c * t * t;
  body.v_dot = 2 * b + 6 * c * t;
  body.frame.X_WB.q = spatial::exp_rotation(axis * value(0.2, 1, -3, 5));
  body.frame.w = axis * rate(1, -3, 5);
  body.w_dot = axis * (2 * -3 + 6 * 5 * t);
  body.d = linalg::Vector::Constant(1, value(0.1, 2, 0, -4));
  body.d_dot = linalg::Vector::Constant(1, rate(2, 0, -4));
  body.d_ddot = linalg::Vector::Constant(1, -24 * t);
  out.lambda = linalg::Vector::Constant(1, 5 - 2 * t);
  out.lambda_time = t;
  return out;
}

TEST(StateInterpolation, IsExactForCubicMotion) {
  const model::State before = cubic_motion(0.1);
  const model::State after = cubic_motion(0.4);
  for (const double t : {0.1, 0.15, 0.25, 0.3875, 0.4}) {
    SCOPED_TRACE(t);
    const model::State exact = cubic_motion(t);
    const model::State found = interpolate(before, after, t);
    EXPECT_EQ(found.t, t);
    EXPECT_EQ(found.lambda_time, t);
    // Rounding only. Rotation about one axis is cubic in its angle.
    EXPECT_NEAR((found.bodies[0].frame.X_WB.p - exact.bodies[0].frame.X_WB.p).norm(), 0, 1e-14);
    EXPECT_NEAR(found.bodies[0].frame.X_WB.q.angularDistance(exact.bodies[0].frame.X_WB.q), 0,
                1e-14);
    EXPECT_NEAR(found.bodies[0].d[0], exact.bodies[0].d[0], 1e-14);
    // Accelerations of a cubic are linear, as assumed.
    EXPECT_NEAR((found.bodies[0].v_dot - exact.bodies[0].v_dot).norm(), 0, 1e-13);
    EXPECT_NEAR((found.bodies[0].w_dot - exact.bodies[0].w_dot).norm(), 0, 1e-13);
    EXPECT_NEAR(found.bodies[0].d_ddot[0], exact.bodies[0].d_ddot[0], 1e-13);
    EXPECT_NEAR(found.lambda[0], exact.lambda[0], 1e-14);
  }
}

TEST(StateInterpolation, PositionsAreOfFourthOrder) {
  const auto error = [](double h) {
    model::State before, after;
    for (model::State* s : {&before, &after}) {
      s->t = s == &before ? 0.8 - 0.5 * h : 0.8 + 0.5 * h;
      s->bodies.resize(1);
      s->bodies[0].frame.X_WB.p = {std::sin(s->t), 0, 0};
      s->bodies[0].frame.v = {std::cos(s->t), 0, 0};
    }
    const double t = 0.8;
    return std::abs(interpolate(before, after, t).bodies[0].frame.X_WB.p.x() - std::sin(t));
  };
  // In the middle h⁴/384 of the fourth derivative; next term of relative size h²/20.
  EXPECT_NEAR(error(0.2) / error(0.1), 16, 0.1);
}

TEST(StateInterpolation, MultipliersOfMidStepAreExtrapolated) {
  // Newmark: λ belongs to the middle of the step that led to the state.
  const double h = 0.1;
  const auto lambda = [](double t) { return linalg::Vector::Constant(2, 7 - 3 * t); };
  model::State before, after;
  before.t = 1.0;
  before.lambda_time = 1.0 - h / 2;
  after.t = 1.0 + h;
  after.lambda_time = 1.0 + h / 2;
  before.lambda = lambda(before.lambda_time);
  after.lambda = lambda(after.lambda_time);
  for (const double t : {1.0, 1.02, 1.05, 1.1}) {
    EXPECT_NEAR((multipliers_at(before, after, t) - lambda(t)).norm(), 0, 1e-13) << t;
  }
  // Two states of one instant leave nothing to extrapolate from.
  before.lambda_time = after.lambda_time;
  EXPECT_EQ(multipliers_at(before, after, 1.1), after.lambda);
}

}  // namespace
}  // namespace buckens::results
