// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "verification/monolithic/stepper.h"

#include "buckens/dynamics/test/example_models.h"
#include "buckens/stepping/stepper.h"

namespace buckens::verification {

inline constexpr stepping::Method kMethods[] = {stepping::Method::generalized_alpha,
                                                stepping::Method::newmark, stepping::Method::hht,
                                                stepping::Method::wilson};

/// Largest difference of a quantity between the two routes, and its largest magnitude.
struct Deviation {
  double difference = 0;
  double size = 0;
  template <class V>
  void add(const V& fast, const V& slow) {
    if (fast.size() == 0) return;
    difference = std::max(difference, (fast - slow).cwiseAbs().maxCoeff());
    size = std::max(size, slow.cwiseAbs().maxCoeff());
  }
};

struct Deviations {
  Deviation d, d_rate, d_acceleration, p, v, w, w_acceleration, lambda;
  double angle = 0;

  void add(const model::State& fast, const model::State& slow) {
    for (std::size_t b = 0; b < fast.bodies.size(); ++b) {
      const model::BodyState& x = fast.bodies[b];
      const model::BodyState& y = slow.bodies[b];
      d.add(x.d.whole(), y.d.whole());
      d_rate.add(x.d_dot.whole(), y.d_dot.whole());
      d_acceleration.add(x.d_ddot.whole(), y.d_ddot.whole());
      d_acceleration.add(x.d_alg.whole(), y.d_alg.whole());
      p.add(x.frame.X_WB.p, y.frame.X_WB.p);
      v.add(x.frame.v, y.frame.v);
      w.add(x.frame.w, y.frame.w);
      w_acceleration.add(x.w_dot, y.w_dot);
      w_acceleration.add(x.w_alg, y.w_alg);
      angle = std::max(angle, x.frame.X_WB.q.angularDistance(y.frame.X_WB.q));
    }
    lambda.add(fast.lambda, slow.lambda);
  }
};

/// Everything to rounding: tolerances of 1e-13 and below.
inline stepping::StepSettings tight(stepping::Method method, double h) {
  stepping::StepSettings settings;
  settings.method = method;
  settings.step = h;
  settings.newton_tolerance = 1e-15;
  settings.outer_tolerance = 1e-13;
  settings.iterate_coupling = true;
  settings.max_newton = 60;
  settings.max_outer = 60;
  return settings;
}

/// Runs both routes from one start and compares where they end.
inline void expect_same(const model::Model& model, const test::Start& start,
                        const stepping::StepSettings& settings, int steps = 200) {
  SCOPED_TRACE(stepping::to_string(settings.method));
  const double h = settings.step;
  stepping::Stepper fast(model, settings, start.rows_in_use);
  MonolithicStepper slow(model, settings, start.rows_in_use);
  model::State a = start.state;
  model::State b = start.state;
  Deviations deviations;
  double mass = 0;
  for (const body::Body& body : model.bodies) mass += body.mass;
  for (int k = 0; k < steps; ++k) {
    fast.step(a);
    slow.step(b);
    deviations.add(a, b);
  }
  EXPECT_EQ(a.t, b.t);
  EXPECT_EQ(a.lambda_time, b.lambda_time);
  EXPECT_EQ(a.history, b.history);
  // Both routes solve the same equations to rounding; up to 200 steps of a motion that is not
  // chaotic amplify it by far less than 1e5, the distance from ε to 1e-10.
  EXPECT_LE(deviations.d.difference, 1e-10 * deviations.d.size);
  EXPECT_LE(deviations.p.difference, 1e-10 * deviations.p.size);
  EXPECT_LE(deviations.angle, 1e-10);
  // Rates are differences of positions over h, accelerations over h².
  EXPECT_LE(h * deviations.d_rate.difference, 1e-10 * deviations.d.size);
  EXPECT_LE(h * h * deviations.d_acceleration.difference, 1e-10 * deviations.d.size);
  EXPECT_LE(h * deviations.v.difference, 1e-10 * deviations.p.size);
  EXPECT_LE(h * deviations.w.difference, 1e-10);
  EXPECT_LE(h * h * deviations.w_acceleration.difference, 1e-10);
  // Positions are known to ε L; a multiplier that moves the mass by that within a step.
  const double rounding =
      10 * std::numeric_limits<double>::epsilon() * mass * model.length / (h * h);
  EXPECT_LE(deviations.lambda.difference, 1e-10 * deviations.lambda.size + rounding);
  // Something must have moved.
  EXPECT_GT(deviations.p.size, 0.1 * model.length);
}

inline test::BeamConstants soft_damped_beam() {
  test::BeamConstants beam;
  beam.EA = 1e4;
  beam.EIy = 60;
  beam.EIz = 100;
  beam.alpha = 0.5;
  beam.beta = 1e-4;
  return beam;
}

}  // namespace buckens::verification
