// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/work_account.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "buckens/analysis/initial/prepare.h"
#include "buckens/analysis/simulation/simulate.h"
#include "buckens/analysis/test/time_law.h"
#include "buckens/model/test/described.h"
#include "buckens/results/table.h"
#include "buckens/stepping/stepper.h"

namespace buckens::analysis {
namespace {

using Eigen::Vector3d;
using model::test::Described;
using results::RunSummary;
using results::Table;

void set_run(Described& m, model::IntegrationMethod method, double duration, double step) {
  m.d.simulation.emplace();
  m.d.simulation->duration = duration;
  m.d.simulation->step = step;
  m.d.simulation->method = method;
  m.d.simulation->rho_inf = 1.0;  // no numerical damping
}

/// Largest |balance|, work and dissipation at the end.
struct Account {
  double balance = 0, work = 0, dissipated = 0, kinetic = 0;
};
Account run(const Described& m) {
  Table table;
  simulate(*m.build(), table);
  const auto last = [&](const char* path) {
    const Eigen::MatrixXd all = table.values(path);
    return all(all.rows() - 1, 0);
  };
  Account out;
  out.balance = table.values("energies/balance").cwiseAbs().maxCoeff();
  out.work = last("energies/work");
  out.dissipated = last("energies/dissipated");
  out.kinetic = last("energies/kinetic");
  return out;
}

constexpr model::IntegrationMethod kMethods[] = {model::IntegrationMethod::generalized_alpha,
                                                 model::IntegrationMethod::newmark};

TEST(WorkAccount, ConstantTorqueDoesTorqueTimesAngle) {
  for (const auto method : kMethods) {
    Described m;
    m.d.planar = spatial::Plane::xy;
    m.rigid("wheel", 1, {0, 0, 0}, {0, 0, 0.5});
    m.joint<joints::RevoluteSpec>("shaft", "ground", "wheel");
    m.torque("motor", "wheel", {0, 0, 2});
    set_run(m, method, 1, 0.01);
    const Account account = run(m);
    // Angle 2 t² = 2 rad; the trapezoidal rule is exact for a linear power.
    EXPECT_NEAR(account.work, 4, 1e-9);
    EXPECT_NEAR(account.kinetic, 4, 1e-9);
    EXPECT_LT(account.balance, 1e-9);
  }
}

TEST(WorkAccount, DriveDoesTheWorkOfTheAcceleration) {
  for (const auto method : kMethods) {
    Described m;
    m.d.planar = spatial::Plane::xy;
    m.rigid("wheel", 1, {0, 0, 0}, {0, 0, 0.5});
    m.joint<joints::RevoluteSpec>("shaft", "ground", "wheel");
    m.joint<joints::PrescribedRotationSpec>("drive", "ground", "wheel").angle =
        test::law_of_time("1.5*t^2");
    set_run(m, method, 1, 0.01);
    const Account account = run(m);
    // ½ J (3 t)² at t = 1.
    EXPECT_NEAR(account.kinetic, 2.25, 1e-6);
    EXPECT_NEAR(account.work, 2.25, 1e-4);
    EXPECT_LT(account.balance, 1e-4);
  }
}

TEST(WorkAccount, DampersTakeTheEnergyOut) {
  Described m;
  m.rigid("block", 2, {0, 0, 0}, {1, 1, 1}).at.position = {1, 0, 0};
  auto& damper = m.load<loads::SpringDamperSpec>("damper");
  damper.between = {model::test::at_marker("ground"), model::test::at_marker("block")};
  damper.damping = 4;
  model::InitialBodySpec initial;
  initial.name = "block";
  initial.velocity = {3, 0, 0};
  m.d.initial.bodies = {initial};
  set_run(m, model::IntegrationMethod::generalized_alpha, 1, 1e-3);
  const Account account = run(m);
  // v = 3 exp(−2 t); errors of second order in h.
  const double lost = 9 * (1 - std::exp(-4.0));
  EXPECT_NEAR(account.dissipated, lost, 1e-4);
  EXPECT_EQ(account.work, 0);
  EXPECT_LT(account.balance, 1e-4);
}

/// A damped flexible beam on a driven hinge.
Described driven_beam(model::IntegrationMethod method, double step) {
  Described m;
  m.d.planar = spatial::Plane::xy;
  m.d.gravity = {0, -9.81, 0};
  body::BodySpec& rod = m.beam("rod", {0, 0, 0}, {1, 0, 0}, 2);
  rod.damping.emplace();
  rod.damping->mass = 40;
  rod.damping->stiffness = 1e-4;
  m.joint<joints::RevoluteSpec>("hinge", "ground", "rod/start");
  m.joint<joints::PrescribedRotationSpec>("drive", "ground", "rod/start").angle =
      test::law_of_time("0.3*(1 - cos(20*t))");
  set_run(m, method, 0.2, step);
  m.d.output.every = 1e-2;
  return m;
}

TEST(WorkAccount, ClosesWithSecondOrder) {
  for (const auto method : kMethods) {
    const Account coarse = run(driven_beam(method, 4e-4));
    const Account fine = run(driven_beam(method, 2e-4));
    const Account finest = run(driven_beam(method, 1e-4));
    EXPECT_GT(finest.dissipated, 0.1);
    // Measured: ratios 4.00 to 4.05, 1e-4 J and 2e-5 J of 38 J work at the finest step.
    EXPECT_LT(finest.balance, 1e-5 * finest.work);
    EXPECT_NEAR(coarse.balance / fine.balance, 4, 0.2) << static_cast<int>(method);
    EXPECT_NEAR(fine.balance / finest.balance, 4, 0.2) << static_cast<int>(method);
  }
}

/// Energy taken by a damped beam that falls about a pin, and products with its matrices.
struct Falling {
  double dissipated = 0;
  long products = 0;
};
Falling fall(stepping::Method method, double step, bool holds_at_states) {
  Described m;
  m.d.planar = spatial::Plane::xy;
  m.d.gravity = {0, -9.81, 0};
  body::BodySpec& rod = m.beam("rod", {0, 0, 0}, {1, 0, 0}, 4);
  rod.damping.emplace();
  rod.damping->mass = 2;
  rod.damping->stiffness = 1e-4;
  m.joint<joints::RevoluteSpec>("pin", "ground", "rod/start");
  const auto built = m.build();
  const dynamics::MassMetric metric(built->model);
  Prepared prepared = prepare(*built, metric);
  stepping::StepSettings settings;
  settings.method = method;
  settings.step = step;
  stepping::Stepper stepper(built->model, settings, prepared.rows_in_use);
  WorkAccount account(built->model, prepared.state, holds_at_states);
  for (long k = 0; k < std::lround(0.1 / step); ++k) {
    stepper.step(prepared.state);
    account.add(prepared.state);
  }
  return {account.work().dissipated, account.num_products()};
}

TEST(WorkAccount, DampingNeedsNoProductsWithStiffness) {
  const auto method = stepping::Method::generalized_alpha;
  const Falling balanced = fall(method, 1e-4, true);
  EXPECT_EQ(balanced.products, 1);  // at the start
  const Falling direct = fall(method, 1e-4, false);
  EXPECT_EQ(direct.products, 1000);
  EXPECT_GT(direct.dissipated, 0.0);
  const double coarse_direct = fall(method, 2e-4, false).dissipated;
  const double fine_direct = fall(method, 5e-5, false).dissipated;
  EXPECT_NEAR((direct.dissipated - coarse_direct) / (fine_direct - direct.dissipated), 4, 0.05);
  // The two differ by vibrations that these steps do not resolve, ω h = 7, and whose rates and
  // displacements tell different velocities: by 2.5 less with each halving, 3.0 at 12 µs.
  const double coarse = fall(method, 2e-4, true).dissipated - coarse_direct;
  const double fine = balanced.dissipated - direct.dissipated;
  EXPECT_LE(std::abs(fine), 1e-4 * direct.dissipated);
  EXPECT_GT(coarse / fine, 2.5);
}

}  // namespace
}  // namespace buckens::analysis
