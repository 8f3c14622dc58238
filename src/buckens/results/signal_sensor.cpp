// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/signal_sensor.h"

#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::results {

namespace {

class SignalSensor final : public Sensor {
 public:
  SignalSensor(Channel channel, std::size_t signal)
      : channel_(std::move(channel)), signal_(signal) {}

  std::vector<Channel> channels() const override { return {channel_}; }
  void append(const Observation& now, std::vector<double>& values) override {
    values.push_back(now.signals[signal_ + 1]);  // the first of them is t
  }

 private:
  Channel channel_;
  std::size_t signal_;
};

}  // namespace

std::unique_ptr<Sensor> make_signal_sensor(const model::BuiltModel& built,
                                           const model::SensorSpec& spec,
                                           const std::string& signal) {
  const auto& all = built.model.signals.all;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (all[k].name != signal) continue;
    return std::make_unique<SignalSensor>(
        Channel{"sensors/" + spec.name, "", {}, fmt::format("signal {}", signal), {}}, k);
  }
  throw InputError(spec.where,
                   fmt::format("sensor \"{}\": there is no signal \"{}\"", spec.name, signal));
}

}  // namespace buckens::results
