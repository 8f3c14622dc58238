// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/gear_sensor.h"

#include <array>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/dynamics/circumstances.h"
#include "buckens/model/elastic_gear.h"
#include "buckens/model/gear_flank.h"

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

/// Of both flanks of rigid teeth: only one of them carries.
class FlankSensor final : public Sensor {
 public:
  FlankSensor(std::vector<Channel> channels, std::array<std::size_t, 2> loads)
      : channels_(std::move(channels)), loads_(loads) {}

  std::vector<Channel> channels() const override { return channels_; }
  void append(const Observation& now, std::vector<double>& values) override {
    double force = 0.0, passed = 0.0;
    for (const std::size_t k : loads_) {
      const model::Load& load = now.model.loads[k];
      const auto first = dynamics::evaluate_marker(now.model, load.first, now.motions).motion;
      const auto second = dynamics::evaluate_marker(now.model, load.second, now.motions).motion;
      const loads::Sight sight =
          dynamics::sight_of(now.model, k, now.state.t, circumstances_of(now), first, second);
      const auto& flank = static_cast<const model::GearFlank&>(*load.element);
      force += flank.signed_force(flank.respond(sight).along_coordinate);
      // Where centres have moved each flank has a part of the play of its own.
      passed += 0.5 * flank.passed(sight.coordinate.value);
    }
    values.insert(values.end(), {force, passed});
  }

 private:
  std::vector<Channel> channels_;
  std::array<std::size_t, 2> loads_;
};

std::vector<Channel> gear_channels(const std::string& sensor, const std::string& gear,
                                   const char* key, const char* what) {
  const std::string path = "sensors/" + sensor;
  return {{path + ".force", "N", {}, fmt::format("force of the teeth of {}", gear), {}},
          {path + "." + key, "m", {}, fmt::format("{} of the teeth of {}", what, gear), {}}};
}

}  // namespace

std::unique_ptr<Sensor> make_gear_sensor(const model::BuiltModel& built,
                                         const model::SensorSpec& spec, const std::string& gear) {
  for (std::size_t k = 0; k < built.model.loads.size(); ++k) {
    const model::Load& load = built.model.loads[k];
    if (load.name != gear) continue;
    if (load.kind == loads::ElasticGearSpec::kKey) {
      return std::make_unique<GearSensor>(
          gear_channels(spec.name, gear, "deflection", "deflection"), k);
    }
    // The other flank stands behind it.
    if (dynamic_cast<const model::GearFlank*>(load.element.get()) != nullptr) {
      return std::make_unique<FlankSensor>(
          gear_channels(spec.name, gear, "play", "way from the middle of the play"),
          std::array<std::size_t, 2>{k, k + 1});
    }
  }
  throw InputError(spec.where, fmt::format("sensor \"{}\": there is no elastic-gear, and no gear "
                                           "or rack with `backlash`, named \"{}\"",
                                           spec.name, gear));
}

}  // namespace buckens::results
