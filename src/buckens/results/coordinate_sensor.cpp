// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/coordinate_sensor.h"

#include <utility>

#include <fmt/format.h>

#include "buckens/dynamics/travel.h"

namespace buckens::results {

namespace {

class CoordinateSensor final : public Sensor {
 public:
  CoordinateSensor(std::vector<Channel> channels, std::size_t coordinate)
      : channels_(std::move(channels)), coordinate_(coordinate) {}

  std::vector<Channel> channels() const override { return channels_; }
  void append(const Observation& now, std::vector<double>& values) override {
    const loads::CoordinateMotion motion = dynamics::coordinate_motion(
        now.model, coordinate_, now.state.t, &now.state.memory, now.motions);
    values.insert(values.end(), {motion.value, motion.rate});
  }

 private:
  std::vector<Channel> channels_;
  std::size_t coordinate_;
};

}  // namespace

std::unique_ptr<Sensor> make_coordinate_sensor(const model::BuiltModel& built,
                                               const model::SensorSpec& spec,
                                               std::size_t coordinate) {
  const model::Coordinate& seen = built.model.coordinates[coordinate];
  const std::string& joint = built.model.joints[static_cast<std::size_t>(seen.joint)].name;
  const bool is_angle = seen.law.is_angle();
  const char* what = base::name_of(seen.which).text;
  const bool is_swing = seen.which == base::CoordinateChoice::swing;
  const std::string path = "sensors/" + spec.name;
  return std::make_unique<CoordinateSensor>(
      std::vector<Channel>{{path + ".value",
                            is_angle ? "rad" : "m",
                            {},
                            fmt::format("{} of joint {}{}", what, joint,
                                        is_swing ? "" : " from its position as placed"),
                            {}},
                           {path + ".rate",
                            is_angle ? "rad/s" : "m/s",
                            {},
                            fmt::format("rate of the {} of joint {}", what, joint),
                            {}}},
      coordinate);
}

}  // namespace buckens::results
