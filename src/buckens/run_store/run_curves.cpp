// SPDX-License-Identifier: Apache-2.0
#include "buckens/run_store/run_curves.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/nearest.h"

namespace buckens::run_store {

namespace {

constexpr std::size_t kMostComponents = 64;
constexpr char kSensors[] = "sensors/";

std::vector<std::string> components_of(const results::Channel& channel) {
  if (channel.shape.empty()) return {""};
  if (channel.components.size() == channel.size()) return channel.components;
  std::vector<std::string> out;
  for (std::size_t k = 1; k <= channel.size(); ++k) out.push_back(fmt::format("{}", k));
  return out;
}

/// A sensor by its name, or any channel by its path.
std::optional<results::Channel> find_channel_called(const RunReader& run, const std::string& name) {
  for (const std::string& path : {kSensors + name, name}) {
    if (auto channel = run.find(path)) return channel;
  }
  return std::nullopt;
}

std::vector<RunCurve> curves_of(const RunReader& run, const results::Channel& channel,
                                const std::string& name) {
  if (channel.size() > kMostComponents) {
    throw InputError(
        fmt::format("\"{}\" holds {} numbers per record; name one that holds few, such "
                    "as a sensor",
                    name, channel.size()));
  }
  const std::vector<std::string> components = components_of(channel);
  const std::vector<double> all = run.read(channel.path);
  const std::size_t width = channel.size();
  std::vector<RunCurve> out;
  for (std::size_t k = 0; k < width; ++k) {
    RunCurve curve{components[k].empty() ? name : name + '.' + components[k], channel.unit, {}};
    for (std::size_t i = k; i < all.size(); i += width) curve.values.push_back(all[i]);
    out.push_back(std::move(curve));
  }
  return out;
}

RunCurve length_of(const std::vector<RunCurve>& curves, const std::string& name) {
  RunCurve out{name + ".norm", curves.front().unit, {}};
  for (std::size_t i = 0; i < curves.front().values.size(); ++i) {
    double sum = 0.0;
    for (const RunCurve& curve : curves) sum += curve.values[i] * curve.values[i];
    out.values.push_back(std::sqrt(sum));
  }
  return out;
}

}  // namespace

std::vector<std::string> sensor_names(const RunReader& run) {
  std::vector<std::string> out;
  for (const results::Channel& channel : run.layout().channels()) {
    if (!channel.path.starts_with(kSensors)) continue;
    const std::string name = channel.path.substr(sizeof kSensors - 1);
    out.push_back(name);
    for (const std::string& component : components_of(channel)) {
      if (!component.empty()) out.push_back(name + '.' + component);
    }
  }
  return out;
}

std::vector<RunCurve> find_curves(const RunReader& run, const std::string& name) {
  if (const auto channel = find_channel_called(run, name)) {
    return curves_of(run, *channel, name);
  }
  const std::size_t dot = name.rfind('.');
  if (dot != name.npos) {
    const std::string whole = name.substr(0, dot);
    const std::string component = name.substr(dot + 1);
    if (const auto channel = find_channel_called(run, whole)) {
      std::vector<RunCurve> curves = curves_of(run, *channel, whole);
      if (component == "norm" && curves.size() > 1) return {length_of(curves, whole)};
      for (RunCurve& curve : curves) {
        if (curve.name == name) return {std::move(curve)};
      }
      std::vector<std::string> known;
      for (const RunCurve& curve : curves) known.push_back(curve.name);
      throw InputError(fmt::format("there is no \"{}\".{}", name, base::suggestion(name, known)));
    }
  }
  const std::vector<std::string> known = sensor_names(run);
  throw InputError(
      fmt::format("there is no sensor \"{}\".{}", name,
                  known.empty() ? " The run has no sensors; name a channel such as energies/total"
                                : base::suggestion(name, known)));
}

}  // namespace buckens::run_store
