// SPDX-License-Identifier: Apache-2.0
// Whether joints have the coordinates that laws, drives, sensors and signals ask for.
#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "buckens/model/check/joint_findings.h"
#include "buckens/model/check/spec_findings.h"

namespace buckens::model {

namespace {

using base::CoordinateSort;

std::string names_of_coordinates(std::span<const base::CoordinateChoice> offered) {
  std::vector<std::string> out;
  for (const base::CoordinateChoice which : offered) {
    out.push_back(fmt::format("`{}`", base::name_of(which).key));
  }
  return fmt::format("{}", fmt::join(out, ", "));
}

/// A joint without what is asked for: joints that have it.
std::string joints_with(std::optional<base::CoordinateChoice> asked, CoordinateSort sort,
                        const ModelDescription& model) {
  std::vector<std::string> fitting;
  for (const joints::JointSpec& other : model.joints) {
    if (base::meant(other.coordinates(), asked, sort)) fitting.push_back(other.name);
  }
  return fitting.empty() ? std::string(" (the model has none)")
                         : fmt::format(": {}", fmt::join(fitting, ", "));
}

/// What a law does not act on, since it is of the other sort.
Found sort_problem(std::optional<base::CoordinateChoice> asked, CoordinateSort sort) {
  if (!asked || base::is_of(*asked, sort)) return std::nullopt;
  const bool takes_angles = sort == CoordinateSort::angles;
  return Finding{
      "which",
      fmt::format("`{}` is {}, but this entry acts on {}; use one that acts on {}",
                  base::name_of(*asked).key, takes_angles ? "a displacement" : "an angle",
                  takes_angles ? "angles" : "displacements",
                  takes_angles ? "displacements: `slide-spring`, `slide-stop`, `slide-motor`, or a "
                                 "drive by `displacement` or `velocity`"
                               : "angles: `hinge-spring`, `hinge-stop`, `hinge-motor`, or a drive "
                                 "by `angle` or `speed`")};
}

}  // namespace

Found coordinate_problem(const CoordinateQuery& query, const ModelDescription& model) {
  const std::string& name = query.joint;
  if (Found found = joint_problem(name, model)) return Finding{query.key, found->text};
  if (Found found = sort_problem(query.asked, query.sort)) return found;
  const joints::JointSpec& joint = *base::find_named(model.joints, name);
  if (base::meant(joint.coordinates(), query.asked, query.sort)) return std::nullopt;
  const std::string start = fmt::format("joint \"{}\" is a {}, ", name, joint.kind_name());
  const char* what = query.asked ? base::name_of(*query.asked).text
                     : query.sort == CoordinateSort::displacements ? "displacement"
                                                                   : "angle";
  const std::string key = query.asked ? query.which_key : query.key;
  if (query.asked == base::CoordinateChoice::second_angle) {
    return Finding{key, start +
                            "which has no second angle; only universal joints turn about two "
                            "axes"};
  }
  const bool has_several =
      !query.asked && std::any_of(joint.coordinates().begin(), joint.coordinates().end(),
                                  [&](auto which) { return base::is_of(which, query.sort); });
  if (has_several) {
    return Finding{key, fmt::format("{}whose coordinates are {}; choose one of them by `which`",
                                    start, names_of_coordinates(joint.coordinates()))};
  }
  if (joint.instead() != nullptr) {
    return Finding{key, fmt::format("{}which has no {}: {}", start, what, joint.instead())};
  }
  const bool is_common = !query.asked || query.asked == base::CoordinateChoice::angle ||
                         query.asked == base::CoordinateChoice::displacement;
  const bool turns = query.asked ? base::name_of(*query.asked).is_angle
                                 : query.sort != CoordinateSort::displacements;
  return Finding{key, fmt::format("{}which has no {}; {}name one that {}{}", start, what,
                                  joint.coordinates().empty() || is_common
                                      ? std::string()
                                      : fmt::format("its coordinates are {}; use them, or ",
                                                    names_of_coordinates(joint.coordinates())),
                                  !is_common ? "has it"
                                  : turns    ? "turns about an axis"
                                             : "slides along an axis",
                                  joints_with(query.asked, query.sort, model))};
}

}  // namespace buckens::model
