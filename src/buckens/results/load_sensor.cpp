// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/load_sensor.h"

#include <optional>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/dynamics/forces.h"
#include "buckens/loads/reaction_follower.h"

namespace buckens::results {

using Eigen::Vector3d;
using model::MarkerId;

namespace {

class LoadSensor final : public Sensor {
 public:
  LoadSensor(Channel channel, std::vector<std::size_t> loads, std::optional<MarkerId> about,
             std::optional<MarkerId> in)
      : channel_(std::move(channel)),
        loads_(std::move(loads)),
        about_(std::move(about)),
        in_(std::move(in)) {}

  std::vector<Channel> channels() const override { return {channel_}; }
  void append(const Observation& now, std::vector<double>& values) override {
    const auto motion = [&](const MarkerId& id) {
      return dynamics::evaluate_marker(now.model, id, now.motions).motion;
    };
    Vector3d sum = Vector3d::Zero();
    const Vector3d point = about_ ? motion(*about_).p : Vector3d::Zero();
    for (const std::size_t k : loads_) {
      const model::Load& load = now.model.loads[k];
      const spatial::MarkerMotion first = motion(load.first);
      const spatial::Wrench wrench =
          dynamics::action_of(now.model, k, now.state.t, circumstances_of(now), first,
                              motion(load.second))
              .on_first;
      sum +=
          about_ ? Vector3d(wrench.torque + (first.p - point).cross(wrench.force)) : wrench.force;
    }
    sum *= now.load_factor;  // only applied loads have this sensor
    if (in_) sum = motion(*in_).R.transpose() * sum;
    values.insert(values.end(), {sum.x(), sum.y(), sum.z()});
  }

 private:
  Channel channel_;
  std::vector<std::size_t> loads_;
  std::optional<MarkerId> about_;  // of torques
  std::optional<MarkerId> in_;
};

/// Whether a force element acts by a torque alone.
bool turns(const model::Model& model, const model::Load& load) {
  if (load.coordinate < 0) {
    const bool rubs = dynamic_cast<const loads::ReactionFollower*>(load.element.get()) != nullptr;
    return rubs || load.kind == "torsional-spring";
  }
  return model.coordinates[static_cast<std::size_t>(load.coordinate)].law.is_angle();
}

}  // namespace

std::unique_ptr<Sensor> make_load_sensor(const model::BuiltModel& built,
                                         const model::SensorSpec& spec, const std::string& load,
                                         bool torque, const std::vector<MarkerId>& about_and_in) {
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < built.model.loads.size(); ++k) {
    if (built.model.loads[k].name != load) continue;
    if (!built.model.loads[k].element->is_applied()) {
      throw InputError(
          spec.where,
          fmt::format(
              "sensor \"{}\": \"{}\" acts between two markers with opposite forces; observe "
              "its `{}`",
              spec.name, load,
              turns(built.model, built.model.loads[k]) ? "spring-torque" : "spring-force"));
    }
    found.push_back(k);
  }
  const std::size_t after = torque ? 1 : 0;
  std::optional<MarkerId> about, in;
  if (torque) about = about_and_in.at(0);
  if (about_and_in.size() > after) in = about_and_in[after];
  Channel channel{"sensors/" + spec.name,
                  torque ? "N m" : "N",
                  {3},
                  fmt::format("resultant {} of load {}", torque ? "torque" : "force", load),
                  {"x", "y", "z"}};
  return std::make_unique<LoadSensor>(std::move(channel), std::move(found), std::move(about),
                                      std::move(in));
}

}  // namespace buckens::results
