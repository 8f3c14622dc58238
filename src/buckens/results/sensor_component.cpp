// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/sensor_component.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "buckens/base/errors.h"

namespace buckens::results {

namespace {

/// What follows the sensor's name in the headings of sensors.csv, one per value.
std::vector<std::string> components_of(const Sensor& sensor, const std::string& name) {
  const std::size_t prefix = std::string("sensors/").size() + name.size();
  std::vector<std::string> out;
  for (const Channel& channel : sensor.channels()) {
    std::string part = channel.path.substr(prefix);
    if (!part.empty()) part.erase(0, 1);  // the point behind the name
    if (channel.components.empty()) {
      out.push_back(part);
      continue;
    }
    for (const std::string& one : channel.components) {
      out.push_back(part.empty() ? one : part + "." + one);
    }
  }
  return out;
}

}  // namespace

std::size_t find_component(const Sensor& sensor, const model::Signal& signal) {
  const std::vector<std::string> known = components_of(sensor, signal.held->sensor);
  const auto& asked = signal.held->component;
  if (!asked && known.size() == 1) return 0;
  const auto found = std::find(known.begin(), known.end(), asked.value_or(""));
  if (found != known.end()) return static_cast<std::size_t>(found - known.begin());
  const std::string which =
      known.size() == 1 && known[0].empty()
          ? "it has a single value, leave `component` out"
          : fmt::format("give as `component` one of {}", fmt::join(known, ", "));
  throw InputError(signal.where,
                   asked ? fmt::format("signal \"{}\": sensor \"{}\" has no component \"{}\"; {}",
                                       signal.name, signal.held->sensor, *asked, which)
                         : fmt::format("signal \"{}\": sensor \"{}\" has {} values; {}",
                                       signal.name, signal.held->sensor, known.size(), which));
}

}  // namespace buckens::results
