// SPDX-License-Identifier: Apache-2.0
// What is wrong with gears, racks and couplers.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "buckens/base/nearest.h"
#include "buckens/model/check/joint_findings.h"
#include "buckens/model/check/marker_names.h"
#include "buckens/model/check/spec_findings.h"

namespace buckens::model {

namespace {

// Teeth of larger angles exist in no catalogue; 90 degrees would be singular.
constexpr double kLargestToothAngle = 60.0 * std::numbers::pi / 180.0;

std::string degrees(double angle) {
  return fmt::format("{:.6g} degrees", angle * 180.0 / std::numbers::pi);
}

/// @param spec with the angles of teeth
template <class Spec>
Found tooth_problem(const Spec& spec, const ModelDescription& model) {
  for (const auto& [key, angle] : {std::pair("pressure-angle", spec.pressure_angle),
                                   std::pair("helix-angle", spec.helix_angle)}) {
    if (std::abs(angle) <= kLargestToothAngle) continue;
    return Finding{
        key, fmt::format("expected at most 60 degrees, found {}; typical values are 20 degrees for "
                         "the pressure angle and 0 to 30 degrees for the helix angle",
                         degrees(angle))};
  }
  if (spec.helix_angle != 0.0 && model.planar) {
    return Finding{"helix-angle",
                   fmt::format("a helix angle of {} causes forces normal to the plane, which a "
                               "planar model cannot have; remove it, or remove `planar`",
                               degrees(spec.helix_angle))};
  }
  return std::nullopt;
}

template <class Spec>
Found gear_problem(const Spec& spec, const ModelDescription& model) {
  if (spec.internal && spec.teeth[0] == spec.teeth[1]) {
    return Finding{"teeth", fmt::format("a ring gear must have more teeth than the gear inside it, "
                                        "but both have {:g}; correct one of them",
                                        spec.teeth[0])};
  }
  if (Found found = tooth_problem(spec, model)) return found;
  return needed_axis_problem(spec.axis, model);
}

/// What belongs to play, and what play needs.
Found play_problem(const joints::ToothPlay& spec) {
  if (spec.backlash == 0.0 && (spec.restitution || spec.threshold)) {
    return Finding{spec.restitution ? "restitution" : "threshold",
                   "without `backlash` the flanks never separate and cannot strike; give a "
                   "`backlash`, for example 0.1 mm, or remove this key"};
  }
  if (spec.restitution.value_or(0.0) > 1.0) {
    return Finding{
        "restitution",
        fmt::format("expected 0 to 1, found {:g}: a rebound cannot be faster than the approach",
                    *spec.restitution)};
  }
  return std::nullopt;
}

Found function_problem(const joints::CouplerTermSpec& term) {
  const int given =
      int{term.factor.has_value()} + int{!term.polynomial.empty()} + int{!term.table.empty()};
  if (given > 1) {
    return Finding{"", "only one of the keys times, polynomial and table can be given"};
  }
  if (term.factor && *term.factor == 0.0) {
    return Finding{"times", "a factor of 0 takes the joint out of the sum; remove the term"};
  }
  if (term.table.empty()) return std::nullopt;
  if (term.table.size() < 2) {
    return Finding{"table",
                   "a table with a single point does not define a curve; give at least two points"};
  }
  for (std::size_t i = 1; i < term.table.size(); ++i) {
    if (term.table[i][0] > term.table[i - 1][0]) continue;
    return Finding{
        fmt::format("table.{}", i),
        fmt::format("coordinates of a table must increase, but {:g} follows {:g}; sort the points",
                    term.table[i][0], term.table[i - 1][0])};
  }
  if (term.table.front()[0] > 0.0 || term.table.back()[0] < 0.0) {
    return Finding{"table", fmt::format("the joint starts at 0, as placed, outside the table, "
                                        "which runs from {:g} to {:g}; add points",
                                        term.table.front()[0], term.table.back()[0])};
  }
  return std::nullopt;
}

Found term_problem(const joints::CouplerTermSpec& term, const ModelDescription& model) {
  if (base::find_named(model.joints, term.name) == nullptr) {
    return Finding{"", fmt::format("unknown joint \"{}\".{}", term.name,
                                   base::suggestion(term.name, names_of(model.joints)))};
  }
  return coordinate_problem({term.name, term.which, base::CoordinateSort::any, ""}, model);
}

Found driven_problem(const joints::PrescribedCoordinateSpec& spec, const ModelDescription& model) {
  if (Found found = joint_problem(spec.joint, model)) return found;
  const joints::JointSpec& joint = *base::find_named(model.joints, spec.joint);
  if (std::holds_alternative<joints::SliderOnBeamSpec>(joint.kind)) {
    return Finding{"joint", fmt::format("joint \"{}\" is a slider-on-beam, which is driven by its "
                                        "own `displacement`, `velocity` or `acceleration`",
                                        spec.joint)};
  }
  if (joint.laws().num_given() > 0) {
    return Finding{"joint", fmt::format("joint \"{}\" is driven already; change its own law, or "
                                        "remove this drive",
                                        spec.joint)};
  }
  return coordinate_problem({spec.joint, spec.which, spec.sort()}, model);
}

}  // namespace

Found own_joint_problem(const joints::GearSpec& spec, const ModelDescription& model) {
  if (Found found = play_problem(spec)) return found;
  for (std::size_t k = 0; spec.backlash > 0.0 && k < spec.teeth.size(); ++k) {
    if (spec.teeth[k] == std::round(spec.teeth[k])) continue;
    return Finding{fmt::format("teeth.{}", k),
                   fmt::format("gears with `backlash` need whole numbers of teeth, since a tooth "
                               "may start in any tooth space; found {:g}",
                               spec.teeth[k])};
  }
  return gear_problem(spec, model);
}

Found own_joint_problem(const loads::ElasticGearSpec& spec, const ModelDescription& model) {
  return gear_problem(spec, model);
}

Found own_joint_problem(const GearSensor& spec, const ModelDescription& model) {
  std::vector<std::string> known;
  for (const loads::LoadSpec& load : model.loads) {
    if (std::holds_alternative<loads::ElasticGearSpec>(load.kind)) known.push_back(load.name);
  }
  for (const joints::JointSpec& joint : model.joints) {
    if (has_play(joint)) known.push_back(joint.name);
  }
  if (std::find(known.begin(), known.end(), spec.gear) != known.end()) return std::nullopt;
  const auto* joint = base::find_named(model.joints, spec.gear);
  if (joint != nullptr && std::holds_alternative<joints::GearSpec>(joint->kind)) {
    return Finding{
        "gear",
        fmt::format(
            "\"{}\" is a joint with rigid teeth and without `backlash`; observe its `joint-force`",
            spec.gear)};
  }
  return Finding{"gear", fmt::format("there is no elastic-gear \"{}\", and no joint with "
                                     "`backlash` of this name.{}",
                                     spec.gear,
                                     known.empty() ? " The model has none."
                                                   : base::suggestion(spec.gear, known))};
}

Found own_joint_problem(const joints::RackSpec& spec, const ModelDescription& model) {
  if (!(spec.along.norm() > 0.0)) {
    return Finding{"along", "[0, 0, 0] is not a direction; give for example [1, 0, 0]"};
  }
  if (Found found = play_problem(spec)) return found;
  if (Found found = tooth_problem(spec, model)) return found;
  return needed_axis_problem(spec.axis, model);
}

Found own_joint_problem(const joints::CouplerSpec& spec, const ModelDescription&) {
  if (spec.of.size() < 2) {
    return Finding{"of", fmt::format("expected at least two joints, found {}; to hold a single "
                                     "coordinate use a `prescribed-rotation` or "
                                     "`prescribed-translation`",
                                     spec.of.size())};
  }
  for (const joints::CouplerTermSpec& term : spec.of) {
    if (Found found = function_problem(term)) return under("of." + term.name, found);
  }
  return std::nullopt;
}

Found own_joint_problem(const joints::PrescribedCoordinateSpec& spec, const ModelDescription&) {
  if (spec.num_given() == 1) return std::nullopt;
  return Finding{"",
                 "exactly one of the keys angle, speed, angular-acceleration, displacement, "
                 "velocity and acceleration is needed, for example velocity: 0.2 m/s"};
}

Found own_joint_problem(const joints::SliderOnBeamSpec& spec, const ModelDescription&) {
  const int given = int{spec.displacement.has_value()} + int{spec.velocity.has_value()} +
                    int{spec.acceleration.has_value()};
  if (given > 1) {
    return Finding{"", "only one of the keys displacement, velocity and acceleration can be given"};
  }
  return std::nullopt;
}

Found own_joint_problem(const joints::RollingSpec& spec, const ModelDescription& model) {
  if (!(spec.normal.norm() > 0.0)) {
    return Finding{"normal", "[0, 0, 0] is not a direction; give for example [0, 0, 1]"};
  }
  if (!spec.axle && !model.planar) {
    return Finding{"axle",
                   "the key \"axle\" is missing; a model in space needs it, for example "
                   "[0, 1, 0]"};
  }
  if (spec.axle && model.planar) {
    return Finding{"axle",
                   "wheels of a planar model turn about the normal of its plane; remove this key"};
  }
  if (spec.axle && !(spec.axle->norm() > 0.0)) {
    return Finding{"axle", "[0, 0, 0] is not a direction; give for example [0, 1, 0]"};
  }
  if (spec.edge > spec.wheel_radius) {
    return Finding{"edge-radius", fmt::format("expected at most the radius of the wheel, {:g} m, "
                                              "found {:g} m",
                                              spec.wheel_radius, spec.edge)};
  }
  return std::nullopt;
}

// Joints may stand in the model file behind the coupler or drive that names them.
Found coupled_joints_problem(const ModelDescription& model) {
  for (const joints::JointSpec& joint : model.joints) {
    if (const auto* drive = std::get_if<joints::PrescribedCoordinateSpec>(&joint.kind)) {
      if (Found found = driven_problem(*drive, model)) {
        return under(fmt::format("joints.{}.prescribed-coordinate", joint.name), found);
      }
    }
    const auto* coupler = std::get_if<joints::CouplerSpec>(&joint.kind);
    if (coupler == nullptr) continue;
    for (const joints::CouplerTermSpec& term : coupler->of) {
      if (Found found = term_problem(term, model)) {
        return under(fmt::format("joints.{}.coupler.of.{}", joint.name, term.name), found);
      }
    }
  }
  return std::nullopt;
}

}  // namespace buckens::model
