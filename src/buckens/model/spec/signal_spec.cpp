// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/spec/signal_spec.h"

#include <tuple>

namespace buckens::model {

SignalSpec::SignalSpec() = default;
SignalSpec::SignalSpec(const SignalSpec&) = default;
SignalSpec::SignalSpec(SignalSpec&&) noexcept = default;
SignalSpec& SignalSpec::operator=(const SignalSpec&) = default;
SignalSpec& SignalSpec::operator=(SignalSpec&&) noexcept = default;
SignalSpec::~SignalSpec() = default;

std::vector<JointReading> joint_readings(const SignalSpec& spec) {
  using base::CoordinateChoice;
  struct Named {
    const char* key;
    const std::optional<std::string>& joint;
    CoordinateChoice which;
    bool is_rate;
  };
  const Named named[] = {
      {"joint-angle", spec.joint_angle, CoordinateChoice::angle, false},
      {"joint-speed", spec.joint_speed, CoordinateChoice::angle, true},
      {"joint-second-angle", spec.joint_second_angle, CoordinateChoice::second_angle, false},
      {"joint-second-speed", spec.joint_second_speed, CoordinateChoice::second_angle, true},
      {"joint-displacement", spec.joint_displacement, CoordinateChoice::displacement, false},
      {"joint-velocity", spec.joint_velocity, CoordinateChoice::displacement, true}};
  std::vector<JointReading> out;
  for (const Named& one : named) {
    if (one.joint) out.push_back({one.key, &*one.joint, one.which, one.is_rate});
  }
  for (const auto& [key, any, is_rate] :
       {std::tuple("joint-coordinate", &spec.joint_coordinate, false),
        std::tuple("joint-rate", &spec.joint_rate, true)}) {
    if (*any) out.push_back({key, &(*any)->joint, (*any)->which, is_rate});
  }
  return out;
}

}  // namespace buckens::model
