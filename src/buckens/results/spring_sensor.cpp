// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/spring_sensor.h"

#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/nearest.h"
#include "buckens/loads/bushing.h"
#include "buckens/loads/joint_law_spec.h"
#include "buckens/loads/spring_damper.h"
#include "buckens/results/action_of_whole.h"

namespace buckens::results {

using Eigen::Vector3d;

namespace {

/// What a force element does to its first marker as the second moves away, in the axes of the
/// first.
class SpringSensor final : public Sensor {
 public:
  enum class Part { along_line, about_axis, force, torque, coordinate };

  /// @param axis_F of Part::about_axis, unit vector in the first marker
  SpringSensor(Channel channel, std::size_t load, Part part, const Vector3d& axis_F)
      : channel_(std::move(channel)), load_(load), part_(part), axis_F_(axis_F) {}

  std::vector<Channel> channels() const override { return {channel_}; }
  void append(const Observation& now, std::vector<double>& values) override {
    const model::Load& load = now.model.loads[load_];
    const dynamics::LoadEnds ends =
        dynamics::ends_of(now.model, load, now.motions, circumstances_of(now).memory);
    const loads::Action action = action_of_whole(now, load_, ends);
    const spatial::MarkerMotion& first = ends.first.motion;
    const spatial::MarkerMotion& second = ends.second.motion;
    const Vector3d force = first.R.transpose() * action.on_first.force;
    // About the second marker: that on the first carries the lever of the force, too.
    const Vector3d torque = -(first.R.transpose() * action.on_second.torque);
    switch (part_) {
      case Part::along_line: {
        const Vector3d line = first.R.transpose() * (second.p - first.p);
        return values.push_back(line.isZero(0.0) ? 0.0 : force.dot(line.normalized()));
      }
      case Part::coordinate:
        return values.push_back(-action.along_coordinate);
      case Part::about_axis:
        return values.push_back(torque.dot(axis_F_));
      case Part::force:
        values.insert(values.end(), {force.x(), force.y(), force.z()});
        return;
      case Part::torque:
        values.insert(values.end(), {torque.x(), torque.y(), torque.z()});
        return;
    }
  }

 private:
  Channel channel_;
  std::size_t load_;
  Part part_;
  Vector3d axis_F_;
};

/// Which part of an element is asked for, if it has that.
std::optional<SpringSensor::Part> part_of(const model::Model& model, const model::Load& load,
                                          bool torque) {
  using Part = SpringSensor::Part;
  const loads::ForceElement& element = *load.element;
  if (load.kind == loads::BallFrictionSpec::kKey) {
    return torque ? std::optional(Part::torque) : std::nullopt;
  }
  if (load.coordinate >= 0) {
    const bool is_torque =
        model.coordinates[static_cast<std::size_t>(load.coordinate)].law.is_angle();
    return torque == is_torque ? std::optional(Part::coordinate) : std::nullopt;
  }
  if (dynamic_cast<const loads::Bushing*>(&element) != nullptr) {
    return torque ? Part::torque : Part::force;
  }
  if (!torque && dynamic_cast<const loads::SpringDamper*>(&element) != nullptr) {
    return Part::along_line;
  }
  if (torque && dynamic_cast<const loads::TorsionalSpring*>(&element) != nullptr) {
    return Part::about_axis;
  }
  return std::nullopt;
}

}  // namespace

std::unique_ptr<Sensor> make_spring_sensor(const model::BuiltModel& built,
                                           const model::SensorSpec& spec, const std::string& spring,
                                           bool torque) {
  std::vector<std::string> known;
  for (std::size_t k = 0; k < built.model.loads.size(); ++k) {
    const model::Load& load = built.model.loads[k];
    const auto part = part_of(built.model, load, torque);
    if (part) known.push_back(load.name);
    if (load.name != spring || !part) continue;
    const bool is_scalar =
        *part != SpringSensor::Part::force && *part != SpringSensor::Part::torque;
    Channel channel{
        "sensors/" + spec.name,
        torque ? "N m" : "N",
        {},
        fmt::format("{} of {} {}, {}", torque ? "torque" : "force", load.kind, load.name,
                    is_scalar && load.coordinate >= 0 ? "positive against its coordinate"
                                                      : "tension positive"),
        {}};
    if (!is_scalar) {
      channel.shape = {3};
      channel.components = {"x", "y", "z"};
    }
    const auto* turning = dynamic_cast<const loads::TorsionalSpring*>(load.element.get());
    return std::make_unique<SpringSensor>(std::move(channel), k, *part,
                                          turning != nullptr ? turning->axis() : Vector3d::UnitZ());
  }
  throw InputError(spec.where,
                   fmt::format("sensor \"{}\": there is no {} \"{}\".{}", spec.name,
                               torque ? "torsional spring or bushing" : "spring-damper or bushing",
                               spring, base::suggestion(spring, known)));
}

}  // namespace buckens::results
