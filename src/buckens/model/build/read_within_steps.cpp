// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/read_within_steps.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/nearest.h"
#include "buckens/loads/bushing.h"
#include "buckens/loads/contact.h"
#include "buckens/loads/joint_law_spec.h"
#include "buckens/loads/spring_damper.h"

namespace buckens::model {

namespace {

using Quantity = MotionReading::Quantity;
using Reading = std::optional<MotionReading>;

/// Turns one signal of a sensor into a reading, if its sensor and component have one.
class WithinStep {
 public:
  WithinStep(const Model& model, const SensorPlace& place, Signal& signal)
      : model_(model),
        place_(place),
        signal_(signal),
        component_(signal.held->component.value_or("")) {}

  Reading operator()(const PositionSensor& spec) const { return marker(Quantity::position, spec); }
  Reading operator()(const VelocitySensor& spec) const { return marker(Quantity::velocity, spec); }
  Reading operator()(const AngularVelocitySensor& spec) const {
    return marker(Quantity::angular_velocity, spec);
  }
  Reading operator()(const RelativeSensor& spec) const {
    using Q = RelativeQuantity;
    if (spec.quantity == Q::angle) return std::nullopt;
    MotionReading out;
    out.first = place_.markers[0];
    out.second = place_.markers[1];
    if (spec.quantity == Q::distance) {
      out.quantity = Quantity::distance;
      return component_.empty() ? Reading(out) : std::nullopt;
    }
    out.quantity = spec.quantity == Q::position   ? Quantity::relative_position
                   : spec.quantity == Q::velocity ? Quantity::relative_velocity
                   : spec.quantity == Q::rotation ? Quantity::relative_rotation
                                                  : Quantity::relative_spin;
    return along_component(out);
  }
  Reading operator()(const JointCoordinateSensor&) {
    if (component_ != "value" && component_ != "rate") return std::nullopt;
    become(component_ == "value" ? Signal::Kind::coordinate : Signal::Kind::coordinate_rate);
    signal_.coordinate = place_.coordinate;
    return std::nullopt;
  }
  Reading operator()(const SpringForceSensor& spec) { return spring(spec.spring, false); }
  Reading operator()(const SpringTorqueSensor& spec) { return spring(spec.spring, true); }
  Reading operator()(const JointForceSensor& spec) const {
    return bushing(spec, Quantity::force_on_second);
  }
  Reading operator()(const JointTorqueSensor& spec) const {
    return bushing(spec, Quantity::torque_on_second);
  }
  Reading operator()(const ContactSensor& spec) const {
    MotionReading out;
    out.load = load_of<loads::Contact>(spec.contact);
    if (out.load < 0) return std::nullopt;
    out.quantity = component_ == "normal"     ? Quantity::normal
                   : component_ == "friction" ? Quantity::friction
                                              : Quantity::gap;
    const bool is_known = component_ == "normal" || component_ == "friction" || component_ == "gap";
    return is_known ? Reading(out) : std::nullopt;
  }
  template <class T>
  Reading operator()(const T&) const {
    return std::nullopt;
  }

 private:
  void become(Signal::Kind kind) {
    signal_.kind = kind;
    signal_.block.reset();
    signal_.held.reset();
  }
  Reading marker(Quantity quantity, const MarkerSensor& spec) const {
    MotionReading out;
    out.quantity = quantity;
    out.first = place_.markers[0];
    if (spec.in) out.axes = place_.markers[1];
    if (!spec.along) return along_component(out);
    out.along = spec.along->normalized();
    return component_.empty() ? Reading(out) : std::nullopt;
  }
  Reading along_component(MotionReading out) const {
    constexpr std::string_view kAxes = "xyz";
    const std::size_t axis = component_.size() == 1 ? kAxes.find(component_) : kAxes.npos;
    if (axis == kAxes.npos) return std::nullopt;
    out.along = Eigen::Vector3d::Unit(static_cast<Eigen::Index>(axis));
    return out;
  }
  template <class Element>
  int load_of(const std::string& name) const {
    for (std::size_t k = 0; k < model_.loads.size(); ++k) {
      const Load& load = model_.loads[k];
      if (load.name == name && dynamic_cast<const Element*>(load.element.get()) != nullptr) {
        return static_cast<int>(k);
      }
    }
    return -1;
  }
  Reading bushing(const JointForceSensor& spec, Quantity quantity) const {
    MotionReading out;
    out.load = load_of<loads::Bushing>(spec.joint);
    if (out.load < 0) return std::nullopt;
    out.quantity = quantity;
    if (spec.in) out.axes = place_.markers[0];
    return along_component(out);
  }
  /// The force of a law on a coordinate has the sign of the coordinate, the sensor that of a
  /// tension.
  bool take_law(const std::string& name, bool turns) {
    for (std::size_t k = 0; k < model_.loads.size(); ++k) {
      const Load& load = model_.loads[k];
      if (load.name != name || load.coordinate < 0) continue;
      const Coordinate& on = model_.coordinates[static_cast<std::size_t>(load.coordinate)];
      if (on.law.is_angle() != turns) continue;
      // A row of a ball is only a part of its torque.
      if (load.kind == loads::BallFrictionSpec::kKey) continue;
      become(Signal::Kind::force);
      signal_.load = static_cast<int>(k);
      signal_.factor = -1.0;
      return true;
    }
    return false;
  }
  Reading spring(const std::string& name, bool turns) {
    MotionReading out;
    out.load = load_of<loads::Bushing>(name);
    if (out.load >= 0) {
      out.quantity = turns ? Quantity::torque_on_first : Quantity::force_on_first;
      return along_component(out);
    }
    if (!component_.empty() || take_law(name, turns)) return std::nullopt;
    out.load = turns ? load_of<loads::TorsionalSpring>(name) : load_of<loads::SpringDamper>(name);
    if (out.load < 0) return std::nullopt;
    out.quantity = turns ? Quantity::torque_on_first : Quantity::tension;
    if (turns) {
      const Load& load = model_.loads[static_cast<std::size_t>(out.load)];
      out.along = static_cast<const loads::TorsionalSpring&>(*load.element).axis();
    }
    return out;
  }

  const Model& model_;
  const SensorPlace& place_;
  Signal& signal_;
  std::string component_;
};

/// @throws InputError naming the signal if there is no such sensor, or it shows a signal itself
std::size_t find_sensor(const Signal& signal, const std::vector<SensorSpec>& sensors) {
  const auto of = std::find_if(sensors.begin(), sensors.end(), [&](const SensorSpec& sensor) {
    return sensor.name == signal.held->sensor;
  });
  if (of == sensors.end()) {
    std::vector<std::string> known;
    for (const SensorSpec& sensor : sensors) known.push_back(sensor.name);
    throw InputError(signal.where, fmt::format("signal \"{}\": unknown sensor \"{}\".{}",
                                               signal.name, signal.held->sensor,
                                               base::suggestion(signal.held->sensor, known)));
  }
  if (const auto* seen = std::get_if<SignalSensor>(&of->kind)) {
    throw InputError(signal.where,
                     fmt::format("signal \"{}\": sensor \"{}\" records signal \"{}\"; use that "
                                 "signal itself",
                                 signal.name, of->name, seen->signal));
  }
  return static_cast<std::size_t>(of - sensors.begin());
}

}  // namespace

void read_within_steps(BuiltModel& built) {
  const std::vector<SensorSpec>& sensors = built.description.output.sensors;
  for (Signal& signal : built.model.signals.all) {
    if (!signal.held) continue;
    const std::size_t index = find_sensor(signal, sensors);
    const Reading reading =
        std::visit(WithinStep(built.model, built.sensors[index], signal), sensors[index].kind);
    if (!reading) continue;
    signal.kind = Signal::Kind::reading;
    signal.reading = *reading;
    signal.block.reset();
    signal.held.reset();
  }
}

}  // namespace buckens::model
