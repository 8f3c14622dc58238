// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/simulate.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/analysis/test/time_law.h"
#include "buckens/base/errors.h"
#include "buckens/model/test/described.h"
#include "buckens/results/table.h"

namespace buckens::analysis {
namespace {

using Eigen::Vector3d;
using model::test::Described;
using results::RunSummary;
using results::Table;
using testing::HasSubstr;
using testing::ThrowsMessage;

void set_run(Described& m, double duration, double step, std::optional<double> every = {}) {
  m.d.simulation.emplace();
  m.d.simulation->duration = duration;
  m.d.simulation->step = step;
  m.d.output.every = every;
}

/// A wheel on a shaft, torque 2 N m, inertia 0.5 kg m²: angle 2 t².
Described driven_wheel() {
  Described m;
  m.d.planar = spatial::Plane::xy;
  m.rigid("wheel", 1, {0, 0, 0}, {0, 0, 0.5});
  m.joint<joints::RevoluteSpec>("shaft", "ground", "wheel");
  m.torque("motor", "wheel", {0, 0, 2});
  return m;
}

/// Rigid rod hanging down from its pin.
Described hanging_rod() {
  Described m;
  m.d.planar = spatial::Plane::xy;
  m.d.gravity = {0, -10, 0};
  m.rigid("rod", 3, {0, -0.5, 0}, {0, 0, 0.2}).markers = {Described::marker("pin", {0, 0, 0})};
  m.joint<joints::RevoluteSpec>("hinge", "ground", "rod/pin");
  m.sensor<model::JointForceSensor>("bearing").joint = "hinge";
  return m;
}

TEST(Simulate, RecordsAtMultiplesOfEvery) {
  Described m = driven_wheel();
  set_run(m, 1.0, 0.01, 0.05);
  Table table;
  const RunSummary summary = simulate(*m.build(), table);
  EXPECT_TRUE(summary.finished);
  EXPECT_EQ(summary.interrupted, "");
  EXPECT_EQ(summary.steps, 100);
  EXPECT_EQ(summary.end_time, 1.0);
  ASSERT_EQ(table.num_records(), 21U);
  for (std::size_t k = 0; k < 21; ++k) {
    EXPECT_NEAR(table.times()[k], 0.05 * static_cast<double>(k), 1e-14);
  }
  ASSERT_TRUE(table.summary());
  EXPECT_TRUE(table.summary()->finished);
}

TEST(Simulate, InterpolatesWhereStepsDoNotFallOnEvery) {
  Described m = driven_wheel();
  auto& angle = m.sensor<model::RelativeSensor>("angle");
  angle.between = {model::test::at_marker("ground"), model::test::at_marker("wheel")};
  angle.quantity = model::RelativeQuantity::angle;
  set_run(m, 1.0, 0.01, 0.0333);
  Table table;
  simulate(*m.build(), table);
  // 0, 0.0333, …, 0.999 and the end itself.
  ASSERT_EQ(table.num_records(), 32U);
  EXPECT_EQ(table.times().back(), 1.0);
  const Eigen::MatrixXd values = table.values("sensors/angle");
  for (std::size_t k = 0; k < table.num_records(); ++k) {
    const double t = k < 31 ? 0.0333 * static_cast<double>(k) : 1.0;
    EXPECT_NEAR(table.times()[k], t, 1e-14);
    // Constant acceleration is integrated and interpolated exactly, to the Newton tolerance.
    EXPECT_NEAR(values(static_cast<Eigen::Index>(k), 0), 2 * t * t, 1e-9);
  }
}

TEST(Simulate, SeveralRecordsFitIntoAStep) {
  Described m = driven_wheel();
  set_run(m, 0.1, 0.05, 0.01);
  Table table;
  const RunSummary summary = simulate(*m.build(), table);
  EXPECT_EQ(summary.steps, 2);
  EXPECT_EQ(table.num_records(), 11U);
}

TEST(Simulate, BalancesEnergyBetweenStepsAsWellAsAtThem) {
  // A stiff rod that starts off straight under gravity vibrates along its axis with about two steps
  // per period: the strain energy of an interpolated state would be far off.
  const auto largest_balance = [](double every) {
    Described m;
    m.d.planar = spatial::Plane::xy;
    m.d.gravity = {0, -10, 0};
    m.beam("rod", {0, 0, 0}, {1, 0, 0}, 4);
    m.joint<joints::RevoluteSpec>("pin", "ground", "rod/start");
    m.force("blow", "rod/end", {1e4, 0, 0});
    set_run(m, 0.01, 1e-4, every);
    Table table;
    simulate(*m.build(), table);
    EXPECT_GT(table.values("energies/strain").maxCoeff(), 0.1);
    return table.values("energies/balance").cwiseAbs().maxCoeff();
  };
  // A linear value between two points exceeds neither, except for rounding of energies of 100 J.
  EXPECT_LE(largest_balance(0.37e-4), largest_balance(1e-4) + 1e-12);
}

TEST(Simulate, AdjustsTheStepToTheDuration) {
  const auto steps = [](double duration, double step) {
    Described m = driven_wheel();
    set_run(m, duration, step);
    Table table;
    const RunSummary summary = simulate(*m.build(), table);
    // Counted as any instant: whole steps, each rounded.
    EXPECT_DOUBLE_EQ(summary.end_time, duration);
    return summary.steps;
  };
  EXPECT_EQ(steps(1.0, 0.3), 4);
  EXPECT_EQ(steps(0.3, 0.1), 3);  // 0.3/0.1 is not 3 in floating point
  EXPECT_EQ(steps(0.1, 0.1), 1);
}

TEST(Simulate, RecordsAboutFiveHundredTimesByDefault) {
  Described m = driven_wheel();
  set_run(m, 1.0, 1e-3);
  Table table;
  simulate(*m.build(), table);
  EXPECT_EQ(table.num_records(), 501U);
}

TEST(Simulate, ProgressCanEndTheRun) {
  Described m = driven_wheel();
  set_run(m, 1.0, 0.01, 0.02);
  SimulationOptions options;
  std::vector<long> seen;
  options.on_progress = [&](const Progress& progress) {
    seen.push_back(progress.step);
    EXPECT_EQ(progress.steps, 100);
    EXPECT_EQ(progress.duration, 1.0);
    return progress.step < 5;
  };
  options.stop_reason = "enough";
  Table table;
  const RunSummary summary = simulate(*m.build(), table, options);
  EXPECT_THAT(seen, testing::ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_FALSE(summary.finished);
  EXPECT_EQ(summary.interrupted, "enough");
  EXPECT_EQ(summary.steps, 5);
  EXPECT_NEAR(summary.end_time, 0.05, 1e-15);
  EXPECT_EQ(table.num_records(), 3U);  // 0, 0.02, 0.04
  ASSERT_TRUE(table.summary());
  EXPECT_FALSE(table.summary()->finished);
}

TEST(Simulate, AFailedStepDeliversWhatCameBefore) {
  // The torque has no value beyond t = 0.05 s.
  Described m = driven_wheel();
  auto& torque = std::get<loads::TorqueSpec>(m.d.loads[0].kind);
  torque.value[2] = test::law_of_time("sqrt(0.05 - t)");
  set_run(m, 0.1, 1e-3, 0.01);
  Table table;
  EXPECT_THAT([&] { simulate(*m.build(), table); },
              ThrowsMessage<NumericalError>(HasSubstr("sqrt(0.05 - t)")));
  ASSERT_TRUE(table.summary());
  EXPECT_FALSE(table.summary()->finished);
  EXPECT_THAT(table.summary()->interrupted, HasSubstr("sqrt(0.05 - t)"));
  EXPECT_NEAR(table.summary()->end_time, 0.05, 1.5e-3);
  ASSERT_GE(table.num_records(), 5U);
  EXPECT_LE(table.num_records(), 6U);
  EXPECT_NEAR(table.times()[4], 0.04, 1e-15);
}

/// Slider on the x axis, pushed by a rod of 0.6 m on a crank of 1 m that turns by angle(t) from φ:
/// stretched across at sin φ = 0.6, the rod does not reach farther.
Described short_rod(double phi, const std::string& angle) {
  Described m;
  m.d.planar = spatial::Plane::xy;
  const double psi = -std::asin(std::sin(phi) / 0.6);
  const Vector3d elbow(std::cos(phi), std::sin(phi), 0);
  const auto turn = [](body::BodySpec& body, double by) {
    body.at.orientation.emplace();
    body.at.orientation->axis = Vector3d::UnitZ();
    body.at.orientation->angle = by;
  };
  body::BodySpec& crank = m.rigid("crank", 1, {0.5, 0, 0}, {0, 0, 0.1});
  crank.markers = {Described::marker("a", {0, 0, 0}), Described::marker("b", {1, 0, 0})};
  turn(crank, phi);
  body::BodySpec& rod = m.rigid("rod", 1, {0.3, 0, 0}, {0, 0, 0.05});
  rod.markers = {Described::marker("a", {0, 0, 0}), Described::marker("b", {0.6, 0, 0})};
  rod.at.position = elbow;
  turn(rod, psi);
  m.rigid("slider", 1, {0, 0, 0}, {0, 0, 0.1}).at.position = {elbow.x() + 0.6 * std::cos(psi), 0,
                                                              0};
  m.joint<joints::RevoluteSpec>("base", "ground", "crank/a");
  m.joint<joints::RevoluteSpec>("elbow", "crank/b", "rod/a");
  m.joint<joints::RevoluteSpec>("pin", "rod/b", "slider");
  m.joint<joints::PrismaticSpec>("guide", "ground", "slider").axis = Vector3d::UnitX();
  m.joint<joints::PrescribedRotationSpec>("drive", "ground", "crank").angle =
      test::law_of_time(angle);
  return m;
}

TEST(Simulate, ALockUpEndsTheRun) {
  for (const auto method :
       {model::IntegrationMethod::generalized_alpha, model::IntegrationMethod::newmark}) {
    SCOPED_TRACE(static_cast<int>(method));
    Described m = short_rod(0.1, "2*t");
    set_run(m, 1.0, 1e-3, 1e-2);
    m.d.simulation->method = method;
    Table table;
    EXPECT_THROW(simulate(*m.build(), table), NumericalError);
    ASSERT_TRUE(table.summary());
    EXPECT_FALSE(table.summary()->finished);
    EXPECT_FALSE(table.summary()->interrupted.empty());
    const double t_lock = (std::asin(0.6) - 0.1) / 2;  // 0.27 s
    EXPECT_LE(table.summary()->end_time, t_lock + 1e-3);
    // Rates grow without bound near the lock-up, so the last few steps may fail.
    EXPECT_GT(table.summary()->end_time, t_lock - 1e-2);
    ASSERT_EQ(table.num_records(),
              1U + static_cast<std::size_t>(table.summary()->end_time / 1e-2 + 1e-6));
    EXPECT_EQ(table.times()[0], 0);
  }
}

TEST(Simulate, NeedsASimulation) {
  Table table;
  EXPECT_THAT([&] { simulate(*driven_wheel().build(), table); },
              ThrowsMessage<InputError>(HasSubstr("`simulation:`")));
  EXPECT_FALSE(table.summary());
}

TEST(Simulate, APendulumAtRestHangsOnItsWeight) {
  for (const auto method :
       {model::IntegrationMethod::generalized_alpha, model::IntegrationMethod::newmark}) {
    Described m = hanging_rod();
    set_run(m, 0.1, 0.01);
    m.d.simulation->method = method;
    Table table;
    simulate(*m.build(), table);
    const Eigen::MatrixXd force = table.values("sensors/bearing");
    for (Eigen::Index k = 0; k < force.rows(); ++k) {
      EXPECT_NEAR((force.row(k).transpose() - Vector3d(0, 30, 0)).norm(), 0, 1e-8) << k;
    }
  }
}

/// Cantilever of 4 elements, clamped at the ground.
Described cantilever() {
  Described m;
  m.beam("rod", {0, 0, 0}, {1, 0, 0}, 4);
  m.joint<joints::FixedSpec>("wall", "ground", "rod/start");
  return m;
}

TEST(Simulate, AStaticCantileverCarriesItsLoad) {
  Described m = cantilever();
  const double F = 10;
  m.force("pull", "rod/end", {0, F, 0});
  m.sensor_of<model::SectionForceSensor>("root", "rod/start");
  m.sensor_of<model::SectionForceSensor>("middle", "rod/mid");
  m.sensor_of<model::StressSensor>("stress", "rod/start");
  m.sensor<model::JointForceSensor>("wall_force").joint = "wall";
  m.sensor<model::JointTorqueSensor>("wall_torque").joint = "wall";
  m.sensor_of<model::DisplacementSensor>("way", "rod/end");
  m.sensor_of<model::PositionSensor>("tip", "rod/end");
  m.d.initial.start = model::StartKind::static_equilibrium;
  set_run(m, 1e-3, 1e-4);
  Table table;
  simulate(*m.build(), table);
  const auto last = [&](const char* name) -> Eigen::VectorXd {
    const Eigen::MatrixXd all = table.values(std::string("sensors/") + name);
    return all.row(all.rows() - 1).transpose();
  };
  // Beam theory; geometry shifts axes by the slope F L²/2EI = 1.3e-3, hence 3e-3 of F.
  EXPECT_NEAR((last("root.force") - Vector3d(0, F, 0)).norm(), 0, 3e-3 * F);
  EXPECT_NEAR((last("root.moment") - Vector3d(0, 0, F)).norm(), 0, 3e-3 * F);
  EXPECT_NEAR((last("middle.moment") - Vector3d(0, 0, F / 2)).norm(), 0, 3e-3 * F);
  const double stress = F / model::test::kIz * model::test::kWidth / 2;
  EXPECT_NEAR(last("stress")[0], stress, 3e-3 * stress);
  EXPECT_NEAR((last("wall_force") - Vector3d(0, -F, 0)).norm(), 0, 1e-6 * F);
  EXPECT_NEAR((last("wall_torque") - Vector3d(0, 0, -F)).norm(), 0, 1e-4 * F);
  const double sag = F / (3 * model::test::kE * model::test::kIz);
  EXPECT_NEAR(last("tip").y(), sag, 1e-4 * sag);
  // It is at rest from the beginning.
  EXPECT_NEAR(last("way").norm(), 0, 1e-6 * sag);
}

TEST(Simulate, CountsOneFactorisationAndOneSolvePerStep) {
  Described m = cantilever();
  m.d.bodies[0].coupling.level = body::CouplingLevel::none;
  m.force("pull", "rod/end", {0, 10, 0});
  set_run(m, 0.01, 1e-4);
  Table table;
  const RunSummary summary = simulate(*m.build(), table);
  ASSERT_EQ(summary.bodies.size(), 1U);
  EXPECT_EQ(summary.bodies[0].name, "rod");
  EXPECT_EQ(summary.bodies[0].dof, 30);
  EXPECT_EQ(summary.bodies[0].factorisations, 1);
  EXPECT_EQ(summary.steps, 100);
  EXPECT_EQ(summary.bodies[0].solves, summary.steps);
}

TEST(Simulate, FullCouplingKeepsTheOneFactorisation) {
  Described m = cantilever();
  m.force("pull", "rod/end", {0, 10, 0});
  m.rigid("block", 1, {0, 0, 0}, {1, 1, 1});
  set_run(m, 0.01, 1e-4);
  Table table;
  const RunSummary summary = simulate(*m.build(), table);
  ASSERT_EQ(summary.bodies.size(), 2U);
  EXPECT_EQ(summary.bodies[0].factorisations, 1);
  EXPECT_GE(summary.bodies[0].solves, summary.steps);
  EXPECT_EQ(summary.bodies[1].dof, 0);
  EXPECT_EQ(summary.bodies[1].factorisations, 0);
  EXPECT_EQ(summary.bodies[1].solves, 0);
}

TEST(Simulate, IsDeterministic) {
  Described m = cantilever();
  m.force("pull", "rod/end", {0, 10, 3});
  m.sensor_of<model::AccelerationSensor>("tip", "rod/end");
  set_run(m, 0.005, 1e-4);
  Table first, second;
  simulate(*m.build(), first);
  simulate(*m.build(), second);
  ASSERT_EQ(first.num_records(), second.num_records());
  for (const results::Channel& channel : first.layout().channels()) {
    // Bit for bit.
    EXPECT_EQ(first.values(channel.path), second.values(channel.path)) << channel.path;
  }
}

}  // namespace
}  // namespace buckens::analysis
