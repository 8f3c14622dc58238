// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/gear_sensor.h"

#include <utility>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/dynamics/circumstances.h"
#include "buckens/model/elastic_gear.h"

namespace buckens::results {

namespace {

class GearSensor final : public Sensor {
 public:
  GearSensor(std::vector<Channel> channels, std::size_t load)
      : channels_(std::move(channels)), load_(load) {}

  std::vector<Channel> channels() const override { return channels_; }
  void append(const Observation& now, std::vector<double>& values) override {
    if (now.state.memory.is_off(load_)) {
      values.insert(values.end(), {0.0, 0.0});
      return;
    }
    const model::Load& load = now.model.loads[load_];
    const auto first = dynamics::evaluate_marker(now.model, load.first, now.motions).motion;
    const auto second = dynamics::evaluate_marker(now.model, load.second, now.motions).motion;
    const model::ElasticGear::Reading reading =
        static_cast<const model::ElasticGear&>(*load.element)
            .read(dynamics::sight_of(now.model, load_, now.state.t, circumstances_of(now), first,
                                     second));
    values.insert(values.end(), {reading.force, reading.deflection});
  }

 private:
  std::vector<Channel> channels_;
  std::size_t load_;
};

}  // namespace

std::unique_ptr<Sensor> make_gear_sensor(const model::BuiltModel& built,
                                         const model::SensorSpec& spec, const std::string& gear) {
  for (std::size_t k = 0; k < built.model.loads.size(); ++k) {
    const model::Load& load = built.model.loads[k];
    if (load.name != gear || load.kind != loads::ElasticGearSpec::kKey) continue;
    const std::string path = "sensors/" + spec.name;
    return std::make_unique<GearSensor>(
        std::vector<Channel>{
            {path + ".force", "N", {}, fmt::format("force of the teeth of {}", gear), {}},
            {path + ".deflection",
             "m",
             {},
             fmt::format("deflection of the teeth of {}", gear),
             {}}},
        k);
  }
  throw InputError(spec.where,
                   fmt::format("sensor \"{}\": there is no elastic-gear \"{}\"", spec.name, gear));
}

}  // namespace buckens::results
