// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/add_coupler.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/model/build/add_joint_law.h"

namespace buckens::model {

namespace {

using Kind = joints::JointCoordinate::Kind;

/// The coordinate that is meant: the one asked for, or the only one. What does not exist was found
/// by the check of the description.
int coordinate_of(const joints::CouplerTermSpec& term, const joints::JointSpec& spec,
                  MarkerFinder& find) {
  if (term.which) {
    using joints::CoordinateChoice;
    const Kind kind = *term.which == CoordinateChoice::angle          ? Kind::angle
                      : *term.which == CoordinateChoice::displacement ? Kind::displacement
                                                                      : Kind::second_angle;
    return find_coordinate(term.name, kind, find);
  }
  const auto& joints = find.model().joints;
  const auto owner = std::find_if(joints.begin(), joints.end(), [&](const Joint& joint) {
    return joint.name == term.name && !joint.is_tie;
  });
  if (owner == joints.end()) {
    throw ModelError(spec.where,
                     fmt::format("joint \"{}\": there is no joint \"{}\"", spec.name, term.name));
  }
  using joints::JointType;
  const bool slides_only = owner->type == JointType::prismatic ||
                           owner->type == JointType::prescribed_translation ||
                           owner->type == JointType::point_on_line;
  return find_coordinate(term.name, slides_only ? Kind::displacement : Kind::angle, find);
}

joints::CoordinateTerm term_of(const joints::CouplerTermSpec& spec, const std::string& owner) {
  joints::CoordinateTerm out;
  out.factor = spec.factor.value_or(1.0);
  if (!spec.polynomial.empty()) {
    out.function = joints::CoordinateFunction::polynomial(spec.polynomial);
  } else if (!spec.table.empty()) {
    out.function = joints::CoordinateFunction::table(spec.table, owner);
  }
  return out;
}

}  // namespace

bool is_coupler(const joints::JointSpec& spec) {
  return std::holds_alternative<joints::CouplerSpec>(spec.kind);
}

void add_coupler(const joints::JointSpec& spec, MarkerFinder& find) {
  Model& model = find.model();
  const std::string what = fmt::format("joint \"{}\"", spec.name);
  Joint coupler;
  coupler.name = spec.name;
  coupler.type = joints::JointType::coupler;
  coupler.where = spec.where;
  bool is_length = true;
  for (const joints::CouplerTermSpec& term : std::get<joints::CouplerSpec>(spec.kind).of) {
    const int index = coordinate_of(term, spec, find);
    const Coordinate& coordinate = model.coordinates[static_cast<std::size_t>(index)];
    const Joint& owner = model.joints[static_cast<std::size_t>(coordinate.joint)];
    const bool turns = coordinate.law.is_angle();
    find.require_moment(owner.first, what, spec.where);
    if (turns) find.require_moment(owner.second, what, spec.where);
    if (coupler.coupled.empty()) {
      coupler.first = owner.first;
      coupler.second = owner.second;
      coupler.axis_F = owner.axis_F;
      is_length = !turns;
    }
    coupler.coupled.push_back({index, term_of(term, what)});
  }
  coupler.rows.push_back(joints::ConstraintRow::coupled(is_length));
  coupler.first_row = model.num_constraint_rows();
  model.joints.push_back(std::move(coupler));
}

}  // namespace buckens::model
