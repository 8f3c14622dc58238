// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/simulation.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/analysis/simulation/simulate.h"
#include "buckens/analysis/test/time_law.h"
#include "buckens/base/errors.h"
#include "buckens/model/test/described.h"
#include "buckens/results/table.h"

namespace buckens::analysis {
namespace {

using Eigen::Vector3d;
using model::test::Described;
using results::Table;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// A beam on a hinge under gravity with a force at its tip.
Described swinging_beam(double duration = 0.05) {
  Described m;
  m.d.gravity = {0, -9.81, 0};
  m.d.planar = spatial::Plane::xy;
  m.beam("rod", {0, 0, 0}, {1, 0, 0}, 4);
  m.joint<joints::RevoluteSpec>("hinge", "ground", "rod/start");
  m.force("push", "rod/end", {0, 20, 0});
  m.sensor_of<model::PositionSensor>("tip", "rod/end");
  auto& angle = m.sensor<model::RelativeSensor>("angle");
  angle.between = {model::test::at_marker("ground"), model::test::at_marker("rod")};
  angle.quantity = model::RelativeQuantity::angle;
  m.d.simulation.emplace();
  m.d.simulation->duration = duration;
  m.d.simulation->step = 1e-3;
  return m;
}

/// A wheel of 0.5 kg m² with a torque of which nothing is known.
Described wheel(double torque) {
  Described m;
  m.d.planar = spatial::Plane::xy;
  m.rigid("wheel", 1, {0, 0, 0}, {0, 0, 0.5});
  m.joint<joints::RevoluteSpec>("shaft", "ground", "wheel");
  m.torque("motor", "wheel", {0, 0, torque});
  m.d.simulation.emplace();
  m.d.simulation->duration = 1;
  m.d.simulation->step = 0.01;
  return m;
}

double spin(const Simulation& simulation) { return simulation.frame("wheel").w.z(); }

TEST(Simulation, StepsByHandAreThoseOfARun) {
  const auto built = swinging_beam().build();
  Table table;
  simulate(*built, table);
  Simulation simulation(*built);
  long steps = 0;
  while (simulation.step()) ++steps;
  EXPECT_EQ(steps, 50);
  EXPECT_EQ(simulation.num_steps(), 50);
  EXPECT_TRUE(simulation.is_done());
  EXPECT_EQ(simulation.time(), simulation.end_time());
  EXPECT_FALSE(simulation.step());
  // To the last bit: sensors show what the run has recorded.
  const Eigen::MatrixXd recorded = table.values("sensors/tip");
  const auto seen = simulation.sensor("tip");
  ASSERT_EQ(seen.size(), 3);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(seen[k], recorded(recorded.rows() - 1, k));
  EXPECT_TRUE(simulation.finish().finished);
}

TEST(Simulation, LookingDoesNotDisturbARun) {
  const auto built = swinging_beam().build();
  Table alone, watched;
  simulate(*built, alone);
  Simulation simulation(*built);
  simulation.record_into(watched);
  simulation.on_step([](const StepView& now) {
    EXPECT_TRUE(std::isfinite(now.sensor("angle")[0]));
    now.simulation().displacements("rod");
  });
  EXPECT_TRUE(simulation.run().finished);
  ASSERT_EQ(watched.num_records(), alone.num_records());
  for (const char* path : {"sensors/angle", "sensors/tip", "joints/hinge/force"}) {
    EXPECT_TRUE(watched.values(path) == alone.values(path)) << path;
  }
}

TEST(Simulation, ViewsStayInPlace) {
  const auto built = swinging_beam().build();
  Simulation simulation(*built);
  const auto displacements = simulation.displacements("rod");
  const auto velocities = simulation.velocities("rod");
  const auto tip = simulation.sensor("tip");
  ASSERT_EQ(displacements.rows(), 5);
  EXPECT_EQ(displacements.cwiseAbs().maxCoeff(), 0.0);
  EXPECT_TRUE(simulation.advance_to(0.02));
  EXPECT_NEAR(simulation.time(), 0.02, 1e-15);
  EXPECT_EQ(simulation.displacements("rod").data(), displacements.data());
  EXPECT_EQ(simulation.velocities("rod").data(), velocities.data());
  EXPECT_EQ(simulation.sensor("tip").data(), tip.data());
  EXPECT_GT(displacements.cwiseAbs().maxCoeff(), 1e-6);
  // Planar and undivided: x and y of node n are the variables 3 n and 3 n + 1.
  EXPECT_EQ(displacements(4, 1), simulation.state().bodies[0].d[13]);
  EXPECT_EQ(velocities(4, 1), simulation.state().bodies[0].d_dot[13]);
}

TEST(Simulation, SeveralFramesShowOneTable) {
  Described m = swinging_beam();
  m.d.bodies[0].frames = 2;
  const auto built = m.build();
  Simulation simulation(*built);
  simulation.advance_to(0.02);
  const auto table = simulation.displacements("rod");
  ASSERT_EQ(table.rows(), 5);
  const auto channel = simulation.values("bodies/rod/displacement");
  EXPECT_TRUE((Eigen::Map<const Eigen::VectorXd>(table.data(), table.size()) == channel));
  EXPECT_THAT([&] { simulation.velocities("rod"); },
              ThrowsMessage<InputError>(HasSubstr("several frames")));
}

TEST(Simulation, UnknownNamesAreRefusedWithTheNearest) {
  const auto built = swinging_beam().build();
  Simulation simulation(*built);
  EXPECT_THAT([&] { simulation.sensor("tipp"); },
              ThrowsMessage<InputError>(HasSubstr("sensors/tip")));
  EXPECT_THAT([&] { simulation.frame("rot"); }, ThrowsMessage<InputError>(HasSubstr("\"rod\"")));
  EXPECT_THAT([&] { simulation.set_load("pusch", Vector3d::Zero()); },
              ThrowsMessage<InputError>(HasSubstr("push")));
  EXPECT_THAT(
      [&] {
        simulation.set_load("push", {NAN, 0, 0});
      },
      ThrowsMessage<InputError>(HasSubstr("not finite")));
}

TEST(Simulation, ACallbackCanStop) {
  const auto built = swinging_beam().build();
  Simulation simulation(*built);
  simulation.on_step([](const StepView& now) {
    if (now.time() > 0.0095) now.stop();
  });
  const results::RunSummary summary = simulation.run();
  EXPECT_FALSE(summary.finished);
  EXPECT_EQ(summary.steps, 10);
  EXPECT_FALSE(simulation.step());
}

TEST(Simulation, AGivenLoadStandsInForItsLaw) {
  // Torque 2 N m on 0.5 kg m²: 4 rad/s². A constant is met exactly by all methods.
  const auto built = wheel(7).build();
  Simulation simulation(*built);
  simulation.set_load("motor", {0, 0, 2});
  simulation.run();
  EXPECT_NEAR(spin(simulation), 4.0, 1e-12);
  EXPECT_NEAR(simulation.values("energies/work")[0], 4.0, 1e-12);  // ½ J w²
  EXPECT_EQ(simulation.values("loads/motor/value")[2], 2.0);
}

TEST(Simulation, ACallbackControlsASpeed) {
  // M = −c w after each step: w falls as exp(−c t/J), late by half a step and so to first order.
  const double c = 0.5;
  double last = 0;
  for (const double h : {0.01, 0.005}) {
    Described m = wheel(0);
    m.d.simulation->step = h;
    model::InitialBodySpec start;
    start.name = "wheel";
    start.angular_velocity = {0, 0, 1};
    m.d.initial.bodies.push_back(start);
    const auto built = m.build();
    Simulation simulation(*built);
    const auto brake = [&] { return Vector3d(0, 0, -c * spin(simulation)); };
    simulation.set_load("motor", brake());
    simulation.on_step([&](const StepView& now) { now.set_load("motor", brake()); });
    EXPECT_TRUE(simulation.run().finished);
    const double error = std::abs(spin(simulation) - std::exp(-c / 0.5));
    EXPECT_LT(error, 0.6 * h);
    if (last > 0) {
      EXPECT_NEAR(last / error, 2.0, 0.1);
    }
    last = error;
  }
}

TEST(Simulation, AReleasedLoadFollowsItsLawAgain) {
  const auto built = wheel(2).build();
  Simulation simulation(*built);
  simulation.set_load("motor", {0, 0, 0});
  simulation.advance_to(0.5);
  EXPECT_EQ(spin(simulation), 0.0);
  simulation.release_load("motor");
  simulation.run();
  // A constant that sets in between two steps is met exactly, too.
  EXPECT_NEAR(spin(simulation), 2.0, 1e-12);
}

TEST(Simulation, ASavedStateGoesOnToTheSameBits) {
  const auto built = swinging_beam().build();
  Simulation whole(*built);
  whole.set_load("push", {0, -5, 0});
  whole.advance_to(0.02);
  const base::SavedValues saved = whole.save();
  whole.run();
  Simulation rest(*built);
  rest.restore(saved);
  EXPECT_EQ(rest.num_steps(), 20);
  ASSERT_EQ(rest.state().inputs.size(), 1U);
  EXPECT_EQ(*rest.state().inputs[0], Vector3d(0, -5, 0));
  rest.run();
  EXPECT_EQ(rest.save(), whole.save());
}

TEST(Simulation, AStateThatDoesNotFitIsRefused) {
  const auto built = swinging_beam().build();
  Simulation first(*built);
  first.advance_to(0.02);
  const base::SavedValues saved = first.save();
  const auto refuses = [&](const base::SavedValues& values, const char* what) {
    Simulation other(*built);
    EXPECT_THAT([&] { other.restore(values); }, ThrowsMessage<InputError>(HasSubstr(what)));
  };
  // Whatever value is missing, too long, out of range or not finite.
  for (const auto& [path, list] : saved.numbers) {
    SCOPED_TRACE(path);
    base::SavedValues damaged = saved;
    damaged.numbers.erase(path);
    refuses(damaged, "it is missing");
    damaged = saved;
    damaged.numbers[path].insert(damaged.numbers[path].end(), 3, 1.0);
    if (!path.ends_with("pivoted")) refuses(damaged, "values, expected");
    if (list.empty()) continue;
    damaged = saved;
    damaged.numbers[path].front() = NAN;
    if (!path.ends_with("pivoted")) refuses(damaged, "not finite");
  }
  for (const auto& [path, list] : saved.counts) {
    base::SavedValues damaged = saved;
    damaged.counts.erase(path);
    refuses(damaged, "it is missing");
    if (list.empty()) continue;
    damaged = saved;
    damaged.counts[path].front() = -2;
    refuses(damaged, path.c_str());
  }
  base::SavedValues other_version = saved;
  other_version.texts["version"] = {"0.0.1"};
  refuses(other_version, "saved by buckens 0.0.1");
}

TEST(Simulation, AnotherModelIsRefusedByWhatDiffers) {
  Simulation first(swinging_beam().build());
  const base::SavedValues saved = first.save();
  Described m = swinging_beam();
  std::get<fem::BeamSpec>(m.d.bodies[0].kind).elements = 5;
  Simulation other(m.build());
  EXPECT_THAT([&] { other.restore(saved); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("another model"),
                                              HasSubstr("bodies.rod.beam.elements was 4, is 5"))));
}

}  // namespace
}  // namespace buckens::analysis
