// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/energy_sensor.h"

#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "buckens/base/errors.h"
#include "buckens/base/nearest.h"
#include "buckens/results/energy_parts.h"

namespace buckens::results {

using Kind = model::EnergyKind;

namespace {

class EnergySensor final : public Sensor {
 public:
  EnergySensor(std::string name, Kind kind) : name_(std::move(name)), kind_(kind) {}

  std::vector<Channel> channels() const override {
    return {{"sensors/" + name_, "J", {}, "energy of the whole model", {}}};
  }
  ObservedParts reads() const override {
    return {kind_ != Kind::work && kind_ != Kind::dissipated, {}};
  }
  void append(const Observation& now, std::vector<double>& values) override {
    values.push_back(value(now));
  }

 private:
  double value(const Observation& now) const {
    const dynamics::Energy& e = now.energy;
    switch (kind_) {
      case Kind::kinetic:
        return e.kinetic;
      case Kind::potential:
        return dynamics::gravity_datum(now.model) + e.strain + e.gravity + e.springs;
      case Kind::strain:
        return e.strain;
      case Kind::work:
        return now.work.external;
      case Kind::dissipated:
        return now.work.dissipated;
      case Kind::balance:
        return now.work.balance;
      default:
        return dynamics::gravity_datum(now.model) + e.total();
    }
  }

  std::string name_;
  Kind kind_;
};

/// A sum of parts of the energy account.
class EnergyPartSensor final : public Sensor {
 public:
  EnergyPartSensor(const model::SensorSpec& spec, Channel channel, EnergyParts parts,
                   const model::EnergySensor& sensor)
      : name_(spec.name),
        where_(spec.where),
        channel_(std::move(channel)),
        parts_(std::move(parts)),
        summed_(parts_.find(sensor.kind, sensor.part.value_or(""))),
        is_held_(is_held(sensor.kind)) {}

  std::vector<Channel> channels() const override { return {channel_}; }
  void append(const Observation& now, std::vector<double>& values) override {
    const bool is_kept = now.work.parts.size() > 0;
    if (!is_kept && !is_held_) refuse();
    const linalg::Vector& parts = is_kept ? now.work.parts : held(now);
    double sum = 0;
    for (const std::size_t k : summed_) sum += parts[static_cast<Eigen::Index>(k)];
    values.push_back(sum);
  }

 private:
  [[noreturn]] void refuse() const {
    throw InputError(where_,
                     fmt::format("sensor \"{}\": parts of work and losses are known of simulations "
                                 "only; in static analyses record `work` or what is held by "
                                 "`springs`, `stops` or `contacts`",
                                 name_));
  }
  /// Where nothing keeps account.
  const linalg::Vector& held(const Observation& now) {
    forces_.account(now.model);
    dynamics::evaluate_forces(now.model, now.motions, now.state.t, circumstances_of(now), forces_,
                              now.load_factor);
    held_.setZero(static_cast<Eigen::Index>(parts_.size()));
    parts_.set_stored(forces_.of_loads, held_);
    return held_;
  }

  std::string name_;
  SourceLocation where_;
  Channel channel_;
  EnergyParts parts_;
  std::vector<std::size_t> summed_;
  bool is_held_;
  dynamics::Forces forces_;
  linalg::Vector held_;
};

void require_part(const model::SensorSpec& spec, const EnergyParts& parts,
                  const model::EnergySensor& sensor, const char* kind) {
  const bool has_parts = sensor.kind == Kind::work || sensor.kind == Kind::dissipated ||
                         is_work(sensor.kind) || is_dissipated(sensor.kind) || is_held(sensor.kind);
  if (!has_parts) {
    throw InputError(spec.where,
                     fmt::format("sensor \"{}\": `{}` is known of the whole model only; "
                                 "leave out `of`",
                                 spec.name, kind));
  }
  if (!parts.find(sensor.kind, *sensor.part).empty()) return;
  const std::vector<std::string> names = parts.names(sensor.kind);
  throw InputError(
      spec.where,
      fmt::format("sensor \"{}\": \"{}\" has no part of the energy `{}`.{} {}", spec.name,
                  *sensor.part, kind, base::suggestion(*sensor.part, names),
                  names.empty() ? std::string("Nothing in the model has one.")
                                : fmt::format("There are parts of: {}", fmt::join(names, ", "))));
}

}  // namespace

std::unique_ptr<Sensor> make_energy_sensor(const model::BuiltModel& built,
                                           const model::SensorSpec& spec,
                                           const model::EnergySensor& sensor) {
  const Kind kind = sensor.kind;
  const bool is_whole = !sensor.part && !is_work(kind) && !is_dissipated(kind) && !is_held(kind);
  if (is_whole) return std::make_unique<EnergySensor>(spec.name, kind);
  EnergyParts parts(built.model);
  const char* const word = choice_names(kind)[static_cast<std::size_t>(kind)];
  if (sensor.part) require_part(spec, parts, sensor, word);
  return std::make_unique<EnergyPartSensor>(
      spec,
      Channel{"sensors/" + spec.name,
              "J",
              {},
              fmt::format("energy `{}` of {}", word, sensor.part.value_or("the whole model")),
              {}},
      std::move(parts), sensor);
}

}  // namespace buckens::results
