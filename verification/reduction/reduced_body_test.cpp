// SPDX-License-Identifier: Apache-2.0
// Steps of reduced bodies against the full mesh and against the monolithic route.
#include <algorithm>

#include <gtest/gtest.h>

#include "verification/monolithic/stepper.h"

#include "buckens/body/reduction.h"
#include "buckens/dynamics/test/example_models.h"
#include "buckens/stepping/test/simulate.h"

namespace buckens::verification::reduction {
namespace {

using linalg::Vector;
using stepping::Method;
using stepping::Stepper;
using stepping::StepSettings;

/// A pendulum in space, reduced to its lowest vibrations with static correction.
model::Model reduced_pendulum(int modes, const body::CouplingChoice& coupling = {}) {
  test::BeamConstants beam;
  beam.EA = 1e4;
  beam.EIy = 60;
  beam.EIz = 100;
  beam.alpha = 0.5;
  beam.beta = 1e-4;
  model::Model model = test::spatial_beam_pendulum(beam, coupling);
  if (modes == 0) return model;
  body::Body& body = model.bodies[0];
  const double length = body.length_scale();
  body.flexible =
      body::reduce(body.name, *body.flexible,
                   body::free_free_basis(body.name, *body.flexible, modes, true, length));
  return model;
}

test::Start spinning(const model::Model& model) {
  return test::consistent_start(model, [](model::State& state) {
    body::FrameMotion& frame = state.bodies[0].frame;
    frame.w << 3, -1, 4;
    frame.v = frame.w.cross(frame.X_WB.p);
  });
}

StepSettings tight(Method method) {
  StepSettings out = test::settings(method, 1e-3);
  out.newton_tolerance = 1e-15;
  out.outer_tolerance = 1e-13;
  out.max_newton = out.max_outer = 60;
  return out;
}

TEST(ReducedBody, StepsAsTheMonolithicRoute) {
  const model::Model model = reduced_pendulum(4);
  const test::Start start = spinning(model);
  for (const Method method :
       {Method::generalized_alpha, Method::newmark, Method::hht, Method::wilson}) {
    SCOPED_TRACE(to_string(method));
    Stepper fast(model, tight(method), start.rows_in_use);
    MonolithicStepper slow(model, tight(method), start.rows_in_use);
    model::State a = start.state, b = start.state;
    double difference = 0, size = 0;
    for (int k = 0; k < 100; ++k) {
      fast.step(a);
      slow.step(b);
      difference = std::max(difference,
                            (a.bodies[0].d.whole() - b.bodies[0].d.whole()).cwiseAbs().maxCoeff());
      size = std::max(size, b.bodies[0].d.whole().cwiseAbs().maxCoeff());
    }
    EXPECT_GT(size, 0.0);
    EXPECT_LE(difference, 1e-10 * size);
    EXPECT_LE((a.bodies[0].frame.X_WB.p - b.bodies[0].frame.X_WB.p).norm(), 1e-11);
  }
}

TEST(ReducedBody, WithAllModesMovesLikeTheFullMesh) {
  for (const body::CouplingLevel level :
       {body::CouplingLevel::full, body::CouplingLevel::first_order, body::CouplingLevel::none}) {
    const model::Model full = reduced_pendulum(0, level), reduced = reduced_pendulum(1000, level);
    const auto settings = tight(Method::generalized_alpha);
    const model::State a = test::simulate(full, spinning(full), settings, 0.2);
    const model::State b = test::simulate(reduced, spinning(reduced), settings, 0.2);
    const Vector d = reduced.bodies[0].flexible->nodal(b.bodies[0].d);
    // Rounding, multiplied by (ω_max/ω_1)² of the mesh, some 1e4.
    EXPECT_LE((d - a.bodies[0].d.whole()).norm(), 1e-9 * a.bodies[0].d.norm()) << to_string(level);
    EXPECT_LE((b.bodies[0].frame.X_WB.p - a.bodies[0].frame.X_WB.p).norm(), 1e-10);
    EXPECT_LE((b.lambda - a.lambda).norm(), 1e-7 * a.lambda.norm());
  }
}

}  // namespace
}  // namespace buckens::verification::reduction
