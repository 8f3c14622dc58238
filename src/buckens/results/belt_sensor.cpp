// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/belt_sensor.h"

#include <utility>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/dynamics/circumstances.h"
#include "buckens/loads/elastic_belt.h"

namespace buckens::results {

namespace {

class BeltSensor final : public Sensor {
 public:
  BeltSensor(std::vector<Channel> channels, std::size_t load)
      : channels_(std::move(channels)), load_(load) {}

  std::vector<Channel> channels() const override { return channels_; }
  void append(const Observation& now, std::vector<double>& values) override {
    const model::Load& load = now.model.loads[load_];
    if (now.state.memory.is_off(load_)) {
      values.insert(values.end(), {0.0, 0.0, 0.0});
      return;
    }
    const auto first = dynamics::evaluate_marker(now.model, load.first, now.motions).motion;
    const auto second = dynamics::evaluate_marker(now.model, load.second, now.motions).motion;
    const loads::BeltReading reading =
        static_cast<const loads::ElasticBelt&>(*load.element)
            .read(dynamics::sight_of(now.model, load_, now.state.t, circumstances_of(now), first,
                                     second));
    values.insert(values.end(), {reading.left, reading.right, reading.slip});
  }

 private:
  std::vector<Channel> channels_;
  std::size_t load_;
};

}  // namespace

std::unique_ptr<Sensor> make_belt_sensor(const model::BuiltModel& built,
                                         const model::SensorSpec& spec, const std::string& belt) {
  for (std::size_t k = 0; k < built.model.loads.size(); ++k) {
    const model::Load& load = built.model.loads[k];
    if (load.name != belt || load.kind != loads::ElasticBeltSpec::kKey) continue;
    const std::string path = "sensors/" + spec.name;
    return std::make_unique<BeltSensor>(
        std::vector<Channel>{
            {path + ".left", "N", {}, fmt::format("tension in the left span of {}", belt), {}},
            {path + ".right", "N", {}, fmt::format("tension in the right span of {}", belt), {}},
            {path + ".slip", "m", {}, fmt::format("slip of belt {}", belt), {}}},
        k);
  }
  throw InputError(spec.where,
                   fmt::format("sensor \"{}\": there is no elastic-belt \"{}\"", spec.name, belt));
}

}  // namespace buckens::results
