// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/check/event_parameters.h"

#include <optional>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/nearest.h"
#include "buckens/model/check/range.h"
#include "buckens/model/spec/description_member.h"

namespace buckens::model {

namespace {

/// A field of a load or joint that takes numbers and formulas of signals alike.
struct Parameter {
  std::string path;
  base::FieldNote note;
  base::SignalLaw* law;  ///< null: not given
};

/// Adds those of one kind of load or joint.
void collect(const std::string& path, const base::Member& kind, std::vector<Parameter>& out) {
  for (base::Field& field : kind.fields()) {
    base::SignalLaw* law = field.member.get<base::SignalLaw>();
    if (auto* given = field.member.get<std::optional<base::SignalLaw>>()) {
      law = *given ? &**given : nullptr;
    } else if (law == nullptr) {
      continue;
    }
    out.push_back({path + "." + field.note.name, std::move(field.note), law});
  }
}

/// Drives are told by their laws, and their joints close with these: they are no force laws.
std::vector<Parameter> parameters_of(const base::Member& model) {
  std::vector<Parameter> out;
  for (const base::Member& load : field_member(model, "loads").parts()) {
    collect("loads." + *load.type->name(load.at), kind_member(load), out);
  }
  for (const base::Member& joint : field_member(model, "joints").parts()) {
    const base::Member kind = kind_member(joint);
    if (!kind.type->is<joints::BushingSpec>()) continue;
    collect("joints." + *joint.type->name(joint.at), kind, out);
  }
  return out;
}

std::string unknown_text(const std::string& path, const std::vector<Parameter>& known) {
  std::vector<std::string> names, beside;
  const std::string owner = path.substr(0, path.rfind('.') + 1);
  for (const Parameter& one : known) {
    names.push_back(one.path);
    if (one.path.starts_with(owner)) beside.push_back(one.path);
  }
  constexpr const char* kWhat =
      "events change numbers of springs and dampers, of friction in joints, motors and brakes, and "
      "the factors of bushings";
  if (!beside.empty()) {
    return fmt::format("events cannot change \"{}\"; here they can change {}", path,
                       fmt::join(beside, ", "));
  }
  return fmt::format("events cannot change \"{}\": {}.{}", path, kWhat,
                     base::suggestion(path, names));
}

}  // namespace

Found parameter_problem(const SettingChange& change, const ModelDescription& model) {
  if (base::find_named(model.signals, change.name) != nullptr) return std::nullopt;  // made already
  const std::vector<Parameter> known = parameters_of(description_member(model));
  const Parameter* found = nullptr;
  for (const Parameter& one : known) {
    if (one.path == change.name) found = &one;
  }
  if (found == nullptr) return Finding{"set", unknown_text(change.name, known)};
  if (found->law == nullptr) {
    return Finding{"set", fmt::format("\"{}\" is not given in the model; give it a number there, "
                                      "which holds until the event",
                                      change.name)};
  }
  const std::string path = "set." + change.name;
  if (!found->law->is_constant()) {
    return Finding{path,
                   "it follows time or signals; let the event change a `setting` that its "
                   "formula names"};
  }
  const auto& unit = change.value.unit;
  if (unit && !base::accepts(found->note.dimension, *unit)) {
    return Finding{path, fmt::format("the value is {}, not {}", base::dimension_name(*unit),
                                     base::dimension_name(found->note.dimension))};
  }
  const std::optional<double> number = change.value.number();
  if (!number) return std::nullopt;
  const auto rule = broken_rule(found->note, *number);
  return rule ? Found(Finding{path, refusal(fmt::format("{:g}", *number), *rule)}) : std::nullopt;
}

void make_settings_of_parameters(ModelDescription& model) {
  for (const EventSpec& event : model.events) {
    for (const SettingChange& change : event.changes) {
      if (!names_parameter(change) || base::find_named(model.signals, change.name) != nullptr) {
        continue;
      }
      for (Parameter& one : parameters_of(description_member(model))) {
        if (one.path != change.name) continue;
        SignalSpec signal;
        signal.name = change.name;
        signal.where = event.where;
        signal.setting = SettingSpec{one.law->value(0.0, {})};
        *one.law = base::SignalLaw::of(change.name, static_cast<int>(model.signals.size()));
        model.signals.push_back(std::move(signal));
      }
    }
  }
}

}  // namespace buckens::model
