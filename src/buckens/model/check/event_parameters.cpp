// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/check/event_parameters.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "buckens/base/nearest.h"
#include "buckens/model/check/contact_findings.h"
#include "buckens/model/check/range.h"
#include "buckens/model/spec/description_member.h"
#include "buckens/spatial/plane.h"

namespace buckens::model {

namespace {

/// A field of a load or joint that events can change.
struct Parameter {
  std::string path;
  base::FieldNote note;
  base::SignalLaw* law = nullptr;  ///< of fields that take formulas of signals; null: not given
  int* setting = nullptr;          ///< of numbers: where the place of their setting is kept
  std::optional<double> number = {};
  const char* needs = "a number";  ///< where it is not given
  loads::ContactForceSpec* contact = nullptr;
  bool is_elastic = false;  ///< the contact

  bool is_given() const { return law != nullptr || number.has_value(); }
};

/// Adds those of one kind of load or joint that take numbers and formulas alike.
void collect(const std::string& path, const base::Member& kind, std::vector<Parameter>& out) {
  for (base::Field& field : kind.fields()) {
    base::SignalLaw* law = field.member.get<base::SignalLaw>();
    if (auto* given = field.member.get<std::optional<base::SignalLaw>>()) {
      law = *given ? &**given : nullptr;
    } else if (law == nullptr) {
      continue;
    }
    out.push_back({join_path(path, field.note.name), field.note, law});
  }
}

/// Adds those of contacts, which are numbers.
void collect_contact(const std::string& path, const base::Member& kind,
                     loads::ContactForceSpec& spec, bool is_elastic, std::vector<Parameter>& out) {
  loads::ContactSettings& at = spec.settings;
  std::vector<Parameter> known;
  const auto add = [&](const char* key, std::optional<double> number, int& setting,
                       const char* needs = "a number") {
    known.push_back({key, {}, nullptr, &setting, number, needs, &spec, is_elastic});
  };
  if (is_elastic) {
    add("stiffness", spec.stiffness, at.stiffness);
    add("damping", spec.damping, at.damping);
  }
  add("restitution", spec.restitution, at.restitution);
  const bool rubs = spec.coefficient > 0.0;
  add("static", rubs ? std::optional(spec.coefficient) : std::nullopt, at.static_coefficient,
      "a number above 0");
  // Without the speed by which it falls, the coefficient is that of sticking throughout.
  add("dynamic", spec.stribeck ? spec.dynamic : std::nullopt, at.dynamic_coefficient,
      "a number, and `stribeck-velocity`,");
  for (base::Field& field : kind.fields()) {
    for (Parameter& one : known) {
      if (one.path != field.note.name) continue;
      one.path = join_path(path, field.note.name);
      one.note = field.note;
      out.push_back(std::move(one));
      break;
    }
  }
}

/// Drives are told by their laws, and their joints close with these: they are no force laws.
std::vector<Parameter> parameters_of(const base::Member& model) {
  std::vector<Parameter> out;
  for (const base::Member& load : field_member(model, "loads").parts()) {
    const base::Member kind = kind_member(load);
    const std::string path = "loads." + *load.type->name(load.at);
    collect(path, kind, out);
    const auto add_contact = [&](auto* contact) {
      if (contact == nullptr) return;
      const bool is_elastic = contact->stiffness || contact->modulus;
      collect_contact(path, kind, *contact, is_elastic, out);
    };
    add_contact(kind.get<loads::ContactSpec>());
    add_contact(kind.get<loads::ContactsSpec>());
  }
  for (const base::Member& joint : field_member(model, "joints").parts()) {
    const base::Member kind = kind_member(joint);
    if (!kind.type->is<joints::BushingSpec>()) continue;
    collect("joints." + *joint.type->name(joint.at), kind, out);
  }
  return out;
}

std::string unknown_text(const std::string& path, const std::vector<Parameter>& known) {
  if (path.starts_with("gravity.")) {
    return fmt::format(
        "events cannot change \"{}\" by itself; change all of it, gravity: [0, "
        "-1.62 m/s^2, 0]",
        path);
  }
  std::vector<std::string> names, beside;
  const std::string owner = path.substr(0, path.rfind('.') + 1);
  for (const Parameter& one : known) {
    names.push_back(one.path);
    if (one.path.starts_with(owner)) beside.push_back(one.path);
  }
  constexpr const char* kWhat =
      "events can change the values of springs and dampers, joint friction, motors and brakes, and "
      "contacts, the factors of bushings, and gravity";
  if (!beside.empty()) {
    return fmt::format("events cannot change \"{}\"; here they can change {}", path,
                       fmt::join(beside, ", "));
  }
  return fmt::format("events cannot change \"{}\": {}.{}", path, kWhat,
                     base::suggestion(path, names));
}

/// A unit that does not fit.
Found unit_problem(const std::string& path, const base::SignalLaw& value,
                   const base::Dimension& wanted) {
  if (!value.unit || base::accepts(wanted, *value.unit)) return std::nullopt;
  return Finding{path, fmt::format("the value is {}, not {}", base::dimension_name(*value.unit),
                                   base::dimension_name(wanted))};
}

Found gravity_problem(const SettingChange& change, const ModelDescription& model) {
  for (std::size_t k = 0; k < 3; ++k) {
    const base::SignalLaw& value = (*change.vector)[k];
    const std::string path = fmt::format("set.gravity.{}", k);
    if (Found found = unit_problem(path, value, base::kAcceleration)) return found;
    const bool is_normal =
        model.planar && spatial::normal(*model.planar)[static_cast<Eigen::Index>(k)] != 0.0;
    if (!is_normal || value.is_number(0.0)) continue;
    return Finding{path,
                   "gravity of a planar model must lie in its plane; set this component, which is "
                   "normal to it, to 0"};
  }
  return std::nullopt;
}

/// What a contact with this restitution would be refused for.
Found changed_restitution_problem(const Parameter& parameter, double value) {
  if (parameter.setting != &parameter.contact->settings.restitution) return std::nullopt;
  loads::ContactForceSpec changed = *parameter.contact;
  changed.restitution = value;
  return restitution_problem(changed, parameter.is_elastic);
}

}  // namespace

Found parameter_problem(const SettingChange& change, const ModelDescription& model) {
  if (names_gravity(change)) return gravity_problem(change, model);
  if (base::find_named(model.signals, change.name) != nullptr) return std::nullopt;  // made already
  const std::vector<Parameter> known = parameters_of(description_member(model));
  const Parameter* found = nullptr;
  for (const Parameter& one : known) {
    if (one.path == change.name) found = &one;
  }
  if (found == nullptr) return Finding{"set", unknown_text(change.name, known)};
  if (!found->is_given()) {
    return Finding{
        "set",
        fmt::format(
            "\"{}\" is not given in the model; give it {} there, which applies until the event",
            change.name, found->needs)};
  }
  const std::string path = "set." + change.name;
  if (found->law != nullptr && !found->law->is_constant()) {
    return Finding{
        path,
        "it depends on time or signals; let the event change a `setting` that its formula uses"};
  }
  if (Found wrong = unit_problem(path, *change.value, found->note.dimension)) return wrong;
  const std::optional<double> number = change.value->number();
  if (!number) return std::nullopt;
  if (const auto rule = broken_rule(found->note, *number)) {
    return Finding{path, refusal(fmt::format("{:g}", *number), *rule)};
  }
  if (found->contact == nullptr) return std::nullopt;
  const Found wrong = changed_restitution_problem(*found, *number);
  return wrong ? Found(Finding{path, wrong->text}) : std::nullopt;
}

namespace {

/// @return its place among all signals
int add_setting(const std::string& name, const EventSpec& event, double start,
                ModelDescription& model) {
  SignalSpec signal;
  signal.name = name;
  signal.where = event.where;
  signal.setting = SettingSpec{start};
  model.signals.push_back(std::move(signal));
  return static_cast<int>(model.signals.size()) - 1;
}

void make_gravity_settings(const EventSpec& event, ModelDescription& model) {
  if (base::find_named(model.signals, kGravitySettings[0]) != nullptr) return;
  for (std::size_t k = 0; k < 3; ++k) {
    add_setting(kGravitySettings[k], event, model.gravity[static_cast<Eigen::Index>(k)], model);
  }
}

void make_setting_of(Parameter& parameter, const EventSpec& event, ModelDescription& model) {
  if (parameter.law != nullptr) {
    const int place = add_setting(parameter.path, event, parameter.law->value(0.0, {}), model);
    *parameter.law = base::SignalLaw::of(parameter.path, place);
    return;
  }
  *parameter.setting = 1 + add_setting(parameter.path, event, *parameter.number, model);
  loads::ContactSettings& all = parameter.contact->settings;
  // Where the model says nothing about it, friction while sliding is that while sticking.
  if (!parameter.contact->dynamic) all.dynamic_coefficient = all.static_coefficient;
}

}  // namespace

void make_settings_of_parameters(ModelDescription& model) {
  for (const EventSpec& event : model.events) {
    for (const SettingChange& change : event.changes) {
      if (names_gravity(change)) make_gravity_settings(event, model);
      if (!change.value || !names_parameter(change) ||
          base::find_named(model.signals, change.name) != nullptr) {
        continue;
      }
      for (Parameter& one : parameters_of(description_member(model))) {
        if (one.path == change.name) make_setting_of(one, event, model);
      }
    }
  }
}

}  // namespace buckens::model
