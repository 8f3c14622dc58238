// SPDX-License-Identifier: Apache-2.0
// Distributed loads: the condensed step against the monolithic one, and momentum against impulse.
#include <algorithm>

#include <gtest/gtest.h>

#include "verification/monolithic/stepper.h"

#include "buckens/dynamics/energy.h"
#include "buckens/dynamics/mass_metric.h"
#include "buckens/model/test/described.h"
#include "buckens/stepping/test/simulate.h"

namespace buckens::verification::loads_on_bodies {
namespace {

using Eigen::Vector3d;
using model::test::constant_law;
using stepping::Method;
using stepping::Stepper;

constexpr int kLoadSteps = 20;

loads::BodyPart part(const std::string& text) { return {model::test::at_line(61), text}; }

/// A rod on a ball joint under a line load that follows it.
void add_rod(model::test::Described& m, const Vector3d& force) {
  auto& rod = m.beam("rod", {0, 1, 0}, {1, 1, 0}, 4);
  std::get<fem::BeamSpec>(rod.kind).material.value.E = 1e9;
  auto& snow = m.load<loads::LineLoadSpec>("snow");
  snow.on = part("rod");
  snow.value = constant_law(force);
  snow.axes = loads::LoadAxes::following;
  auto& ball = m.joint<joints::SphericalSpec>("ball", "ground", "rod/start");
  ball.between[0].point = Vector3d(0, 1, 0);
}

/// A soft block in free flight under pressure and traction of both kinds, a beam under a line load.
std::unique_ptr<model::BuiltModel> loaded_bodies() {
  model::test::Described m;
  auto& block = m.block("block", {0.4, 0.2, 0.1}, {2, 1, 1});
  std::get<fem::MeshSpec>(block.kind).material->value.E = 1e7;
  auto& gas = m.load<loads::PressureSpec>("gas");
  gas.on = part("block/x1");
  gas.value = base::TimeLaw::expression(base::Expression("2e4*(1+sin(200*t))", {"t"}, {}, {}));
  auto& wind = m.load<loads::TractionSpec>("wind");
  wind.on = part("block/z1");
  wind.value = constant_law({2000, 1000, -500});
  auto& drag = m.load<loads::TractionSpec>("drag");
  drag.on = part("block/y0");
  drag.value = constant_law({-3000, 4000, 1000});
  drag.axes = loads::LoadAxes::following;
  add_rod(m, {0, 1, -3});
  return m.build();
}

test::Start at_rest(const model::Model& model) {
  return test::consistent_start(model,
                                [](model::State& state) { state.bodies[0].frame.w << 1, -2, 1.5; });
}

TEST(LoadsOnBodies, StepAsTheMonolithicRoute) {
  const auto built = loaded_bodies();
  const test::Start start = at_rest(built->model);
  for (const Method method :
       {Method::generalized_alpha, Method::newmark, Method::hht, Method::wilson}) {
    SCOPED_TRACE(to_string(method));
    stepping::StepSettings settings = test::settings(method, 2e-4);
    settings.newton_tolerance = 1e-15;
    settings.outer_tolerance = 1e-13;
    settings.max_newton = settings.max_outer = 60;
    Stepper fast(built->model, settings, start.rows_in_use);
    MonolithicStepper slow(built->model, settings, start.rows_in_use);
    model::State a = start.state, b = start.state;
    double difference[2] = {0, 0}, size[2] = {0, 0};
    for (int k = 0; k < kLoadSteps; ++k) {
      fast.step(a);
      slow.step(b);
      for (std::size_t body = 0; body < 2; ++body) {
        const linalg::Vector &x = a.bodies[body].d, &y = b.bodies[body].d;
        difference[body] = std::max(difference[body], (x - y).cwiseAbs().maxCoeff());
        size[body] = std::max(size[body], y.cwiseAbs().maxCoeff());
      }
    }
    for (std::size_t body = 0; body < 2; ++body) {
      SCOPED_TRACE(body);
      EXPECT_GT(size[body], 1e-6) << "the load does something";
      // Rounding of the steps, far below 1e5 ε; see fast_equals_monolithic.
      EXPECT_LE(difference[body], 1e-10 * size[body]);
      EXPECT_LE((a.bodies[body].frame.X_WB.p - b.bodies[body].frame.X_WB.p).norm(), 1e-11);
    }
  }
}

/// Bent by 3 % of its length the rod has six times the inertia about its length that it has
/// straight, and the rounds of the coupling converge by 0.3 to 0.8: half a dozen per decade. Taking
/// the slow convergence for rounding left 6e-9 of the deflection.
TEST(LoadsOnBodies, LargeDeflectionsConvergeSlowlyToTheMonolithicStep) {
  model::test::Described m;
  add_rod(m, {0, 20, -300});
  const auto built = m.build();
  const test::Start start = test::consistent_start(built->model, [](model::State&) {});
  stepping::StepSettings settings = test::settings(Method::generalized_alpha, 2e-4);
  settings.newton_tolerance = 1e-15;
  settings.outer_tolerance = 1e-13;
  settings.max_newton = settings.max_outer = 300;
  Stepper fast(built->model, settings, start.rows_in_use);
  MonolithicStepper slow(built->model, settings, start.rows_in_use);
  model::State a = start.state, b = start.state;
  int most_solves = 0;
  double difference = 0;
  for (int k = 0; k < 150; ++k) {
    most_solves = std::max(most_solves, fast.step(a).large_solve_rounds);
    slow.step(b);
    difference =
        std::max(difference, (a.bodies[0].d.whole() - b.bodies[0].d.whole()).cwiseAbs().maxCoeff());
  }
  const double size = b.bodies[0].d.whole().cwiseAbs().maxCoeff();
  EXPECT_GT(size, 0.02);
  EXPECT_GT(most_solves, 12) << "this is the case that converges slowly";
  // Rounding of 150 steps; see fast_equals_monolithic.
  EXPECT_LE(difference, 1e-10 * size);
}

TEST(LoadsOnBodies, ConstantLoadsGiveTheirImpulse) {
  model::test::Described m;
  m.block("block", {0.4, 0.2, 0.1}, {2, 1, 1});
  auto& wind = m.load<loads::TractionSpec>("wind");
  wind.on = part("block/x1");
  wind.value = constant_law({2e5, 1e5, -5e4});
  const auto built = m.build();
  const test::Start start = test::consistent_start(built->model, [](model::State&) {});
  Stepper stepper(built->model, test::settings(Method::generalized_alpha, 1e-5), start.rows_in_use);
  model::State state = start.state;
  for (int k = 0; k < 200; ++k) stepper.step(state);
  const Vector3d impulse = 0.02 * Vector3d(2e5, 1e5, -5e4) * state.t;
  EXPECT_NEAR((dynamics::momentum(built->model, state).linear - impulse).norm(), 0,
              1e-11 * impulse.norm());
}

}  // namespace
}  // namespace buckens::verification::loads_on_bodies
