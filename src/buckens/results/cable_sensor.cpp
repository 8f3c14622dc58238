// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/cable_sensor.h"

#include <utility>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/dynamics/travel.h"
#include "buckens/loads/cable.h"

namespace buckens::results {

namespace {

class CableSensor final : public Sensor {
 public:
  CableSensor(std::vector<Channel> channels, std::size_t load)
      : channels_(std::move(channels)), load_(load) {}

  std::vector<Channel> channels() const override { return channels_; }
  void append(const Observation& now, std::vector<double>& values) override {
    if (now.state.memory.is_off(load_)) {
      values.insert(values.end(), channels_.size(), 0.0);
      return;
    }
    const model::Load& load = now.model.loads[load_];
    const dynamics::LoadEnds ends =
        dynamics::ends_of(now.model, load, now.motions, &now.state.memory);
    const loads::CableReading reading =
        static_cast<const loads::Cable&>(*load.element)
            .read(dynamics::sight_of(now.model, load_, now.state.t, circumstances_of(now), ends));
    for (const auto* part : {&reading.tensions, &reading.wraps, &reading.slips}) {
      values.insert(values.end(), part->begin(), part->end());
    }
  }

 private:
  std::vector<Channel> channels_;
  std::size_t load_;
};

}  // namespace

std::unique_ptr<Sensor> make_cable_sensor(const model::BuiltModel& built,
                                          const model::SensorSpec& spec, const std::string& cable) {
  for (std::size_t k = 0; k < built.model.loads.size(); ++k) {
    const model::Load& load = built.model.loads[k];
    const auto* element = dynamic_cast<const loads::Cable*>(load.element.get());
    if (load.name != cable || element == nullptr) continue;
    const std::string path = "sensors/" + spec.name;
    std::vector<Channel> channels;
    const auto add = [&](const char* key, const char* unit, const char* text, std::size_t count) {
      for (std::size_t n = 1; n <= count; ++n) {
        channels.push_back({fmt::format("{}.{}{}", path, key, n),
                            unit,
                            {},
                            fmt::format("{} {} of {}", text, n, cable),
                            {}});
      }
    };
    add("tension", "N", "tension in span", element->num_spans());
    add("wrap", "rad", "wrap around pulley", element->num_pulleys());
    add("slip", "m", "slip over pulley", element->num_pulleys());
    return std::make_unique<CableSensor>(std::move(channels), k);
  }
  throw InputError(spec.where,
                   fmt::format("sensor \"{}\": there is no cable \"{}\"", spec.name, cable));
}

}  // namespace buckens::results
