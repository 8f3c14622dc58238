// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/contact_sensor.h"

#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/dynamics/circumstances.h"
#include "buckens/dynamics/contact_groups.h"
#include "buckens/loads/contact.h"
#include "buckens/loads/rigid_law.h"
#include "buckens/model/contact_group.h"

namespace buckens::results {

namespace {

class ContactSensor final : public Sensor {
 public:
  ContactSensor(std::vector<Channel> channels, std::size_t load)
      : channels_(std::move(channels)), load_(load) {}

  std::vector<Channel> channels() const override { return channels_; }
  void append(const Observation& now, std::vector<double>& values) override {
    const model::Load& load = now.model.loads[load_];
    const auto first = dynamics::evaluate_marker(now.model, load.first, now.motions).motion;
    const auto second = dynamics::evaluate_marker(now.model, load.second, now.motions).motion;
    const loads::Sight sight =
        dynamics::sight_of(now.model, load_, now.state.t, circumstances_of(now), first, second);
    if (const auto* elastic = dynamic_cast<const loads::Contact*>(load.element.get())) {
      const loads::ContactReading reading = elastic->read(sight);
      const bool is_on = !now.state.memory.is_off(load_);
      values.insert(values.end(),
                    {is_on ? reading.normal : 0.0, is_on ? reading.friction : 0.0, reading.gap});
      return;
    }
    const auto& stop = static_cast<const loads::RigidStop&>(*load.element);
    values.insert(values.end(), {std::abs(stop.respond(sight).along_coordinate), 0.0,
                                 stop.contact(sight.coordinate.value).gap});
  }

 private:
  std::vector<Channel> channels_;
  std::size_t load_;
};

class ContactsSensor final : public Sensor {
 public:
  ContactsSensor(std::vector<Channel> channels, std::size_t group)
      : channels_(std::move(channels)), group_(group) {}

  std::vector<Channel> channels() const override { return channels_; }
  void append(const Observation& now, std::vector<double>& values) override {
    const dynamics::GroupReading reading =
        dynamics::read_group(now.model, group_, now.motions, now.state.t, circumstances_of(now));
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
    return std::make_unique<ContactSensor>(
        std::vector<Channel>{
            {path + ".normal", "N", {}, fmt::format("normal force of contact {}", contact), {}},
            {path + ".friction", "N", {}, fmt::format("friction force of contact {}", contact), {}},
            {path + ".gap", "m", {}, fmt::format("least distance of contact {}", contact), {}}},
        k);
  }
  throw InputError(spec.where,
                   fmt::format("sensor \"{}\": there is no contact \"{}\"", spec.name, contact));
}

}  // namespace buckens::results
