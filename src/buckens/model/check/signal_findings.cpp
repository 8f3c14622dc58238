// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "buckens/base/nearest.h"
#include "buckens/model/check/event_parameters.h"
#include "buckens/model/check/joint_findings.h"
#include "buckens/model/check/marker_names.h"
#include "buckens/model/check/spec_findings.h"

namespace buckens::model {

namespace {

int num_given(const SignalSpec& s) {
  return static_cast<int>(joint_readings(s).size()) + int{s.value.has_value()} +
         int{s.position.has_value()} + int{s.velocity.has_value()} + int{s.force_of.has_value()} +
         int{s.sensor.has_value()} + int{s.integral.has_value()} + int{s.lag.has_value()} +
         int{s.transfer_function.has_value()} + int{s.state_space.has_value()} +
         int{s.pid.has_value()} + int{s.sample_hold.has_value()} + int{s.table.has_value()} +
         int{s.rate_limit.has_value()} + int{s.switched.has_value()} + int{s.setting.has_value()};
}

}  // namespace

Found problem(const SignalSpec& spec, const ModelDescription& model) {
  if (num_given(spec) != 1) {
    return Finding{
        "",
        "exactly one of the keys value, joint-angle, joint-speed, "
        "joint-second-angle, joint-second-speed, "
        "joint-displacement, joint-velocity, joint-coordinate, joint-rate, position, velocity, "
        "force-of, sensor, "
        "integral, lag, transfer-function, state-space, pid, sample-hold, "
        "table, rate-limit, switch and setting is needed"};
  }
  for (const JointReading& read : joint_readings(spec)) {
    const bool is_any = spec.joint_coordinate || spec.joint_rate;
    const CoordinateQuery query =
        is_any ? CoordinateQuery{*read.joint, read.which, base::CoordinateSort::any,
                                 std::string(read.key) + ".joint", std::string(read.key) + ".which"}
               : CoordinateQuery{*read.joint, read.which, base::CoordinateSort::any, read.key,
                                 read.key};
    if (Found found = coordinate_problem(query, model)) return found;
  }
  return std::nullopt;
}

Found problem(const TableSignalSpec& spec, const ModelDescription&) {
  if (spec.points.size() < 2) {
    return Finding{
        "points",
        "a table with a single point does not define a function; give at least two points"};
  }
  for (std::size_t k = 1; k < spec.points.size(); ++k) {
    if (spec.points[k][0] > spec.points[k - 1][0]) continue;
    return Finding{fmt::format("points.{}", k),
                   fmt::format("inputs of a table must increase, but {:g} follows {:g}; sort the "
                               "points",
                               spec.points[k][0], spec.points[k - 1][0])};
  }
  return std::nullopt;
}

Found problem(const SwitchSpec& spec, const ModelDescription&) {
  if (!spec.off || *spec.off != spec.on) return std::nullopt;
  return Finding{
      "off",
      fmt::format("it switches on and off at the same level, {:g}; give two different levels",
                  spec.on)};
}

namespace {

/// All but gravity is one number.
Found value_problem(const SettingChange& change) {
  const std::string path = "set." + change.name;
  if (change.value.has_value() == change.vector.has_value()) {
    return Finding{
        path,
        "give either `value` (a number or formula) or, for gravity, `vector` (three of them)"};
  }
  if (change.name == "gravity" || !change.vector) return std::nullopt;
  return Finding{path, "only gravity takes three values; give one number or formula"};
}

/// The settings that an event changes.
Found changes_problem(const EventSpec& spec, const ModelDescription& model) {
  std::vector<std::string> settings;
  for (const SignalSpec& signal : model.signals) {
    if (signal.setting) settings.push_back(signal.name);
  }
  for (const SettingChange& change : spec.changes) {
    if (Found found = value_problem(change)) return found;
    if (names_parameter(change)) {
      if (Found found = parameter_problem(change, model)) return found;
      continue;
    }
    if (std::find(settings.begin(), settings.end(), change.name) != settings.end()) continue;
    if (base::find_named(model.signals, change.name) != nullptr) {
      return Finding{"set",
                     fmt::format("signal \"{}\" follows from the motion; only signals with a "
                                 "`setting` can be set",
                                 change.name)};
    }
    if (change.name == "gravity") {
      return Finding{"set.gravity",
                     "gravity has three components; give for example [0, -1.62 m/s^2, 0]"};
    }
    return Finding{"set", fmt::format("unknown signal \"{}\".{}", change.name,
                                      base::suggestion(change.name, settings))};
  }
  return std::nullopt;
}

/// The loads, and joints that give way, that can be switched.
Found switches_problem(const std::vector<std::string>& switched, const char* key,
                       const ModelDescription& model) {
  std::vector<std::string> known = names_of(model.loads);
  for (const joints::JointSpec& joint : model.joints) {
    if (std::holds_alternative<joints::BushingSpec>(joint.kind)) known.push_back(joint.name);
  }
  for (const OwnForce& force : model.own_forces) known.push_back(force.name);
  for (const std::string& name : switched) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const bool is_joint = base::find_named(model.joints, name) != nullptr;
    return Finding{
        key, is_joint ? fmt::format("\"{}\" is a joint, and joints cannot be switched; name it "
                                    "under `lock`, `unlock` or `release`",
                                    name)
                      : fmt::format("unknown load \"{}\".{}", name, base::suggestion(name, known))};
  }
  return std::nullopt;
}

Found locks_problem(const std::vector<std::string>& joints, const char* key,
                    const ModelDescription& model) {
  for (const std::string& name : joints) {
    const auto* joint = base::find_named(model.joints, name);
    if (joint == nullptr) {
      return Finding{key, fmt::format("unknown joint \"{}\".{}", name,
                                      base::suggestion(name, names_of(model.joints)))};
    }
    const bool is_driven = std::string(joint->kind_name()).starts_with("prescribed");
    const bool is_bent = joint->has(base::CoordinateChoice::swing);
    if (!joint->coordinates().empty() && !is_bent && !is_driven) continue;
    if (is_bent) {
      return Finding{key,
                     fmt::format("joint \"{}\" is a {}, which has no angle or displacement to "
                                 "hold: its coordinates do not fully determine its position; name "
                                 "a `fixed` joint under `attach` that holds its bodies `as-found`",
                                 name, joint->kind_name())};
    }
    return Finding{key, fmt::format("joint \"{}\" is a {}, which {}; name one that turns about or "
                                    "slides along an axis and is not driven",
                                    name, joint->kind_name(),
                                    is_driven ? "follows its law of time"
                                              : "has no angle or displacement to hold")};
  }
  return std::nullopt;
}

}  // namespace

Found problem(const EventSpec& spec, const ModelDescription& model) {
  if (base::find_named(model.signals, spec.when) == nullptr) {
    return Finding{"when", fmt::format("unknown signal \"{}\".{}", spec.when,
                                       base::suggestion(spec.when, names_of(model.signals)))};
  }
  if (Found found = changes_problem(spec, model)) return found;
  if (Found found = switches_problem(spec.switch_on, "switch-on", model)) return found;
  if (Found found = switches_problem(spec.switch_off, "switch-off", model)) return found;
  if (Found found = locks_problem(spec.lock, "lock", model)) return found;
  if (Found found = locks_problem(spec.unlock, "unlock", model)) return found;
  if (Found found = attached_problem(spec.attach, "attach", model)) return found;
  for (const std::string& name : spec.release) {
    const auto* joint = base::find_named(model.joints, name);
    if (joint == nullptr) {
      return Finding{"release", fmt::format("unknown joint \"{}\".{}", name,
                                            base::suggestion(name, names_of(model.joints)))};
    }
    if (has_play(*joint)) return released_play_problem(*joint, "release");
    if (std::holds_alternative<joints::BushingSpec>(joint->kind)) {
      return Finding{"release", fmt::format("joint \"{}\" is a bushing; name it under "
                                            "`switch-off`",
                                            name)};
    }
  }
  return std::nullopt;
}

Found problem(const MarkerSignalSpec& spec, const ModelDescription&) {
  if (spec.along.norm() > 0.0) return std::nullopt;
  return Finding{"along", "[0, 0, 0] is not a direction; give for example [0, -1, 0]"};
}

Found problem(const TransferFunctionSpec& spec, const ModelDescription&) {
  if (spec.denominator.empty() || spec.denominator.front() == 0.0) {
    return Finding{
        "denominator",
        "its first coefficient, of the highest power of s, must not be 0; remove leading zeros"};
  }
  if (spec.numerator.empty()) return Finding{"numerator", "it needs at least one coefficient"};
  if (spec.numerator.size() > spec.denominator.size()) {
    return Finding{
        "numerator",
        fmt::format("its order {} exceeds that of the denominator, {}: it would differentiate its "
                    "input; use a `pid` with `filter`, or give the denominator more powers",
                    spec.numerator.size() - 1, spec.denominator.size() - 1)};
  }
  return std::nullopt;
}

Found problem(const StateSpaceSpec& spec, const ModelDescription&) {
  const std::size_t n = spec.A.size();
  const auto wrong = [&](const char* key, std::size_t count) {
    return Finding{key, fmt::format("the system has {} states (rows of A), but this has {} entries",
                                    n, count)};
  };
  for (const auto& row : spec.A) {
    if (row.size() != n) return wrong("A", row.size());
  }
  if (n == 0) return Finding{"A", "it needs at least one state"};
  if (spec.B.size() != n) return wrong("B", spec.B.size());
  if (spec.C.size() != n) return wrong("C", spec.C.size());
  if (!spec.start.empty() && spec.start.size() != n) return wrong("start", spec.start.size());
  return std::nullopt;
}

Found problem(const PidSpec& spec, const ModelDescription&) {
  if (spec.proportional == 0.0 && spec.integral == 0.0 && spec.derivative == 0.0) {
    return Finding{"",
                   "a controller without `proportional`, `integral` and `derivative` does "
                   "nothing; give at least one of them"};
  }
  if (spec.derivative != 0.0 && !spec.filter && !spec.sample) {
    return Finding{"filter",
                   "the key \"filter\" is missing; a continuous derivative needs the time constant "
                   "of its filter, for example filter: 5 ms"};
  }
  if (spec.limits && !((*spec.limits)[0] < (*spec.limits)[1])) {
    return Finding{"limits",
                   fmt::format("the lower limit {:g} is not below the upper limit {:g}; swap them",
                               (*spec.limits)[0], (*spec.limits)[1])};
  }
  if (spec.tracking && (spec.sample || !spec.limits)) {
    return Finding{
        "tracking-time",
        spec.sample
            ? "a sampled controller stops its integral immediately at its limits; remove this key"
            : "it requires `limits`; add them, or remove this key"};
  }
  return std::nullopt;
}

}  // namespace buckens::model
