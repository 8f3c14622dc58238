// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/analysis/simulation/simulation.h"
#include "buckens/base/errors.h"
#include "buckens/model/test/described.h"

namespace buckens::analysis {
namespace {

using model::test::Described;
using testing::HasSubstr;
using testing::ThrowsMessage;

double wheel_spin(const Simulation& simulation) { return simulation.frame("wheel").w.z(); }

TEST(SetSignal, AMotorFollowsASettingThatIsSet) {
  Described m;
  m.d.planar = spatial::Plane::xy;
  m.rigid("wheel", 1, {0, 0, 0}, {0, 0, 0.5});
  m.joint<joints::RevoluteSpec>("shaft", "ground", "wheel");
  m.d.simulation.emplace();
  m.d.simulation->duration = 1;
  m.d.simulation->step = 0.01;
  model::SignalSpec command;
  command.name = "command";
  command.setting.emplace();
  m.d.signals.push_back(command);
  base::SignalLaw follow;
  follow.formula.emplace("command", std::vector<std::string>{"t", "command"}, base::Parameters{},
                         SourceLocation{});
  follow.names = {"command"};
  follow.places = {0};
  auto& motor = m.load<loads::HingeMotorSpec>("drive");
  motor.joint = "shaft";
  motor.force = follow;
  const auto built = m.build();
  Simulation simulation(*built);
  simulation.set_signal("command", 2);
  EXPECT_EQ(simulation.signal("command"), 2);
  simulation.advance_to(0.5);
  EXPECT_NEAR(wheel_spin(simulation), 2.0, 1e-12);  // 4 rad/s² from the first instant on
  const base::SavedValues saved = simulation.save();
  Simulation other(*built);
  other.restore(saved);
  EXPECT_EQ(other.signal("command"), 2);
  for (Simulation* one : {&simulation, &other}) {
    one->on_step([](const StepView& now) { now.set_signal("command", -now.time()); });
    one->run();
  }
  EXPECT_EQ(wheel_spin(simulation), wheel_spin(other));
  // What is set at the end of a step acts over the next one: ω̇ = 4 in the first, then −2t of the
  // start of each, in all 0.04 − 2·0.01·(0.51 + … + 0.99) = −0.695.
  EXPECT_NEAR(wheel_spin(simulation), 2.0 - 0.695, 1e-12);
  EXPECT_THAT([&] { other.set_signal("comand", 1); },
              ThrowsMessage<InputError>(HasSubstr("Did you mean \"command\"?")));
}

TEST(SetSignal, LeavesGravityToEvents) {
  Described m;
  m.rigid("stone", 1, {0, 0, 0}, {0, 0, 0.5});
  m.d.simulation.emplace();
  m.d.simulation->duration = 1;
  m.d.simulation->step = 0.01;
  model::SignalSpec height;
  height.name = "height";
  height.value.emplace(1.0);
  m.d.signals.push_back(height);
  model::EventSpec event;
  event.name = "lands";
  event.when = "height";
  model::SettingChange& change = event.changes.emplace_back();
  change.name = "gravity";
  change.vector.emplace();
  m.d.events.push_back(event);
  const auto built = m.build();
  Simulation simulation(*built);
  EXPECT_THAT([&] { simulation.set_signal("gravity.2", 1); },
              ThrowsMessage<InputError>(HasSubstr("\"gravity.2\" is a component of gravity")));
}

}  // namespace
}  // namespace buckens::analysis
