// SPDX-License-Identifier: Apache-2.0
#include "buckens/results/energy_parts.h"

#include <algorithm>

#include "buckens/loads/contact_friction.h"

namespace buckens::results {

using Kind = model::EnergyKind;

namespace {

Kind kind_of_supply(const model::Load& load) {
  return load.kind.ends_with("-motor") ? Kind::drives : Kind::loads;
}

bool is_contact(const model::Load& load) {
  return load.kind == "contact" || load.kind == "contacts";
}

Kind kind_of_loss(const model::Load& load) {
  if (dynamic_cast<const loads::ContactFriction*>(load.element.get()) != nullptr) {
    return Kind::contact_friction;
  }
  if (load.kind.ends_with("-friction") || load.kind.ends_with("-brake")) {
    return Kind::joint_friction;
  }
  if (load.kind == "cable" || load.kind == "elastic-belt") return Kind::belts;
  return load.element->is_rigid() ? Kind::impacts : Kind::damping;
}

Kind kind_of_storage(const model::Load& load) {
  if (is_contact(load)) return Kind::contacts;
  return load.kind.ends_with("-stop") || load.kind == "rope" ? Kind::stops : Kind::springs;
}

bool includes(Kind wanted, Kind kind) {
  if (wanted == Kind::work) return is_work(kind);
  if (wanted == Kind::dissipated) return is_dissipated(kind);
  return wanted == kind;
}

}  // namespace

bool is_work(Kind kind) {
  return kind == Kind::loads || kind == Kind::drives || kind == Kind::events;
}

bool is_dissipated(Kind kind) {
  return kind == Kind::joint_friction || kind == Kind::contact_friction || kind == Kind::belts ||
         kind == Kind::impacts || kind == Kind::damping;
}

bool is_held(Kind kind) {
  return kind == Kind::springs || kind == Kind::stops || kind == Kind::contacts;
}

EnergyParts::EnergyParts(const model::Model& model) {
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const model::Joint& joint = model.joints[j];
    const bool is_driven =
        std::any_of(joint.rows.begin(), joint.rows.end(),
                    [](const joints::ConstraintRow& row) { return row.depends_on_time(); }) ||
        std::any_of(model.drives.begin(), model.drives.end(), [j](const model::Drive& drive) {
          return static_cast<std::size_t>(drive.joint) == j;
        });
    if (!is_driven) continue;
    drives_.push_back({joint.first_row, static_cast<int>(joint.rows.size()),
                       add(Kind::drives, joint.name, joint.name)});
  }
  for (const model::Load& load : model.loads) loads_.push_back(add_load(model, load));
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const std::string& name =
        model.wholes.empty()
            ? model.bodies[b].name
            : model.wholes[static_cast<std::size_t>(model.whole_of(static_cast<int>(b)))].name;
    bodies_.push_back(add(Kind::damping, name));
  }
  events_ = add(Kind::events, "");
  locks_ = add(Kind::impacts, "");
}

void EnergyParts::follow_pairs(const model::Model& model) {
  loads_.clear();
  for (const model::Load& load : model.loads) loads_.push_back(add_load(model, load));
}

EnergyParts::OfLoad EnergyParts::add_load(const model::Model& model, const model::Load& load) {
  const int joint = load.joint >= 0 ? load.joint
                    : load.coordinate >= 0
                        ? model.coordinates[static_cast<std::size_t>(load.coordinate)].joint
                        : -1;
  const std::string on = joint >= 0 ? model.joints[static_cast<std::size_t>(joint)].name : "";
  const auto part = [&](Kind kind) { return add(kind, load.name, on); };
  const Kind loss = kind_of_loss(load);
  OfLoad out{};
  out.supplied = part(kind_of_supply(load));
  out.lost = part(loss);
  out.rubbed = is_contact(load) ? part(Kind::contact_friction) : out.lost;
  out.struck = loss == Kind::contact_friction ? out.lost : part(Kind::impacts);
  out.stored = part(kind_of_storage(load));
  return out;
}

std::size_t EnergyParts::add(Kind kind, const std::string& of, const std::string& joint) {
  const auto [known, is_new] = places_.try_emplace({kind, of}, all_.size());
  if (is_new) all_.push_back({kind, of, joint});
  return known->second;
}

std::vector<std::size_t> EnergyParts::find(Kind kind, const std::string& of) const {
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < all_.size(); ++k) {
    const bool is_meant = of.empty() || all_[k].of == of || all_[k].joint == of;
    if (includes(kind, all_[k].kind) && is_meant) out.push_back(k);
  }
  return out;
}

std::vector<std::string> EnergyParts::names(Kind kind) const {
  std::vector<std::string> out;
  for (const EnergyPart& part : all_) {
    if (!includes(kind, part.kind)) continue;
    for (const std::string& name : {part.of, part.joint}) {
      const bool is_known = std::find(out.begin(), out.end(), name) != out.end();
      if (!name.empty() && !is_known) out.push_back(name);
    }
  }
  return out;
}

void EnergyParts::set_stored(std::span<const dynamics::LoadPower> loads,
                             linalg::Vector& parts) const {
  for (const OfLoad& load : loads_) parts[static_cast<Eigen::Index>(load.stored)] = 0.0;
  for (std::size_t k = 0; k < loads.size(); ++k) {
    parts[static_cast<Eigen::Index>(loads_[k].stored)] += loads[k].stored;
  }
}

}  // namespace buckens::results
