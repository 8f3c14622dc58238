// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/function_signal.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/model/build/function_signals.h"
#include "buckens/model/test/described.h"

namespace buckens::model {
namespace {

using test::Described;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

SignalSpec& add_signal(Described& m, const std::string& name) {
  SignalSpec spec;
  spec.name = name;
  spec.where = test::at_line(80 + static_cast<int>(m.d.signals.size()));
  m.d.signals.push_back(std::move(spec));
  return m.d.signals.back();
}

/// A wheel, its angle and speed, and a command from outside in front of them.
Described wheel() {
  Described m;
  m.d.planar = spatial::Plane::xy;
  m.rigid("wheel", 1, {0, 0, 0}, {0, 0, 0.5});
  m.joint<joints::RevoluteSpec>("shaft", "ground", "wheel");
  add_signal(m, "command").setting.emplace();
  add_signal(m, "angle").joint_angle = "shaft";
  add_signal(m, "speed").joint_speed = "shaft";
  return m;
}

double sum(double t, std::span<const double> values) {
  double out = 10.0 * t;
  for (const double value : values) out += value;
  return out;
}

TEST(FunctionSignal, TakesTimeAndItsInputs) {
  const FunctionSignal signal("command", {"speed", "angle"}, {2, 1}, [](double t, auto values) {
    EXPECT_THAT(values, ElementsAre(5, 3));
    return 10.0 * t + values[0] - values[1];
  });
  const std::vector<double> all = {0.25, 7, 3, 5};  // t and the values in the order of the model
  EXPECT_EQ(signal.value_at(0.25, all), 4.5);
  EXPECT_TRUE(signal.takes("angle"));
  EXPECT_FALSE(signal.takes("command"));
  EXPECT_EQ(signal.num_states(), 0);
}

TEST(FunctionSignal, RefusesWhatIsNotFinite) {
  const FunctionSignal signal("command", {"angle"}, {1}, [](double, auto) { return NAN; });
  const std::vector<double> all = {0.25, 7, 3};
  EXPECT_THAT([&] { signal.value_at(0.25, all); },
              ThrowsMessage<NumericalError>(AllOf(HasSubstr("\"command\""), HasSubstr("gives nan"),
                                                  HasSubstr("t = 0.25 s, angle = 3"))));
}

TEST(FunctionSignal, TakesThePlaceOfASettingAfterItsInputs) {
  const auto built = wheel().build();
  EXPECT_EQ(built->model.signals.num_states, 1);
  EXPECT_THAT(built->model.signals.order, ElementsAre(0, 1, 2));
  give_functions({{"command", {"angle", "speed"}, sum}}, *built);
  EXPECT_EQ(built->model.signals.num_states, 0);
  EXPECT_THAT(built->model.signals.order, ElementsAre(1, 2, 0));
  const FunctionSignal* function = function_of(built->model.signals.all[0]);
  ASSERT_NE(function, nullptr);
  EXPECT_EQ(function->value_at(1, std::vector<double>{1, 0, 2, 3}), 15);
  EXPECT_EQ(function_of(built->model.signals.all[1]), nullptr);
}

TEST(FunctionSignal, LoopsAndWhatFollowsFromTheMotionAreRefused) {
  const auto give = [](const std::string& name, const std::string& input) {
    const auto built = wheel().build();
    give_functions({{name, {input}, sum}}, *built);
  };
  EXPECT_THAT([&] { give("command", "command"); },
              ThrowsMessage<ModelError>(HasSubstr("algebraic loop: \"command\" needs")));
  EXPECT_THAT([&] { give("angle", "speed"); },
              ThrowsMessage<ModelError>(HasSubstr("\"angle\" follows from the motion")));
  EXPECT_THAT([&] { give("comand", "speed"); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("\"comand\""), HasSubstr("\"command\"?"))));
  EXPECT_THAT(
      [&] { give("command", "sped"); },
      ThrowsMessage<InputError>(AllOf(HasSubstr("takes \"sped\""), HasSubstr("\"speed\"?"))));
}

TEST(FunctionSignal, EventsMayNotSetWhatAFunctionGives) {
  Described m = wheel();
  EventSpec event;
  event.name = "far";
  event.when = "angle";
  SettingChange& change = event.changes.emplace_back();
  change.name = "command";
  change.value = 1.0;
  m.d.events.push_back(event);
  const auto built = m.build();
  EXPECT_THAT(
      [&] {
        give_functions({{"command", {}, sum}}, *built);
      },
      ThrowsMessage<ModelError>(AllOf(HasSubstr("\"far\""), HasSubstr("\"command\""))));
}

}  // namespace
}  // namespace buckens::model
