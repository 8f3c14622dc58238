// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/contact_sensor.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/dynamics/circumstances.h"
#include "buckens/dynamics/contact_groups.h"
#include "buckens/loads/contact.h"
#include "buckens/loads/contact_friction.h"
#include "buckens/model/contact_group.h"

namespace buckens::results {

namespace {

class ContactSensor final : public Sensor {
 public:
  /// @param count number of loads that the contact is, from `load` on
  ContactSensor(std::vector<Channel> channels, std::size_t load, std::size_t count)
      : channels_(std::move(channels)), load_(load), count_(count) {}

  std::vector<Channel> channels() const override { return channels_; }
  void append(const Observation& now, std::vector<double>& values) override {
    const loads::ContactReading reading = read(now);
    const bool is_on = !now.state.memory.is_off(load_);
    values.insert(values.end(),
                  {is_on ? reading.normal : 0.0, is_on ? reading.friction : 0.0, reading.gap});
  }

 private:
  loads::ContactReading read(const Observation& now) const {
    loads::ContactReading out{0.0, 0.0, HUGE_VAL};
    Eigen::Vector3d friction = Eigen::Vector3d::Zero();
    for (std::size_t k = load_; k < load_ + count_; ++k) {
      const model::Load& load = now.model.loads[k];
      const auto first = dynamics::evaluate_marker(now.model, load.first, now.motions).motion;
      const auto second = dynamics::evaluate_marker(now.model, load.second, now.motions).motion;
      const loads::Sight sight =
          dynamics::sight_of(now.model, k, now.state.t, circumstances_of(now), first, second);
      if (const auto* elastic = dynamic_cast<const loads::Contact*>(load.element.get())) {
        loads::ContactReading touching = elastic->read(sight);
        const auto& at_rest = now.state.memory.at_rest;
        if (!at_rest.empty()) touching.friction = at_rest[k].force;  // frozen
        return touching;
      }
      const auto& law = static_cast<const loads::RigidLaw&>(*load.element);
      const loads::Action action = law.respond(sight);
      if (dynamic_cast<const loads::ContactFriction*>(&law) != nullptr) {
        friction += action.on_second.force;
        continue;
      }
      out.normal += std::abs(action.along_coordinate);
      out.gap = std::min(out.gap, law.contact(sight.coordinate.value).gap);
    }
    out.friction = friction.norm();
    return out;
  }

  std::vector<Channel> channels_;
  std::size_t load_, count_;
};

class ContactsSensor final : public Sensor {
 public:
  ContactsSensor(std::vector<Channel> channels, std::size_t group)
      : channels_(std::move(channels)), group_(group) {}

  std::vector<Channel> channels() const override { return channels_; }
  void append(const Observation& now, std::vector<double>& values) override {
    dynamics::GroupReading reading =
        dynamics::read_group(now.model, group_, now.motions, now.state.t, circumstances_of(now));
    const auto& at_rest = now.state.memory.at_rest;
    if (!at_rest.empty() && !now.model.contact_groups[group_]->rigid) {
      reading.friction = at_rest[now.model.contact_groups[group_]->load].force;  // frozen
    }
    values.insert(values.end(),
                  {reading.normal, reading.friction, static_cast<double>(reading.touching)});
  }

 private:
  std::vector<Channel> channels_;
  std::size_t group_;
};

std::unique_ptr<Sensor> make_contacts_sensor(const model::Model& model, const std::string& path,
                                             std::size_t load) {
  const std::string& name = model.loads[load].name;
  std::size_t group = 0;
  while (model.contact_groups[group]->load != load) ++group;
  return std::make_unique<ContactsSensor>(
      std::vector<Channel>{
          {path + ".normal", "N", {}, fmt::format("sum of the normal forces of {}", name), {}},
          {path + ".friction", "N", {}, fmt::format("sum of the friction forces of {}", name), {}},
          {path + ".touching", "", {}, fmt::format("number of pairs that touch in {}", name), {}}},
      group);
}

}  // namespace

std::unique_ptr<Sensor> make_contact_sensor(const model::BuiltModel& built,
                                            const model::SensorSpec& spec,
                                            const std::string& contact) {
  for (std::size_t k = 0; k < built.model.loads.size(); ++k) {
    const model::Load& load = built.model.loads[k];
    const bool is_group = load.kind == loads::ContactsSpec::kKey;
    if (load.name != contact || !(is_group || load.kind == loads::ContactSpec::kKey)) continue;
    const std::string path = "sensors/" + spec.name;
    if (is_group) return make_contacts_sensor(built.model, path, k);
    std::size_t count = 1;
    while (k + count < built.model.loads.size() && built.model.loads[k + count].name == contact) {
      ++count;
    }
    return std::make_unique<ContactSensor>(
        std::vector<Channel>{
            {path + ".normal", "N", {}, fmt::format("normal force of contact {}", contact), {}},
            {path + ".friction", "N", {}, fmt::format("friction force of contact {}", contact), {}},
            {path + ".gap", "m", {}, fmt::format("least distance of contact {}", contact), {}}},
        k, count);
  }
  throw InputError(spec.where,
                   fmt::format("sensor \"{}\": there is no contact \"{}\"", spec.name, contact));
}

}  // namespace buckens::results
