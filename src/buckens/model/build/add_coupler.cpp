// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/add_coupler.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/model/build/add_joint_law.h"

namespace buckens::model {

namespace {

/// Index of a coordinate that a coupler or a drive takes. What does not exist was found by the
/// check of the description, but for joints that come later.
int coordinate_of(const std::string& joint, std::optional<base::CoordinateChoice> which,
                  base::CoordinateSort sort, const joints::JointSpec& spec, MarkerFinder& find) {
  const int out = find_coordinate(joint, which, sort, find);
  if (out >= 0) return out;
  throw ModelError(spec.where,
                   fmt::format("joint \"{}\": there is no joint \"{}\"", spec.name, joint));
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
  return std::holds_alternative<joints::CouplerSpec>(spec.kind) ||
         std::holds_alternative<joints::PrescribedCoordinateSpec>(spec.kind);
}

namespace {

/// Adds a row over coordinates of other joints.
class CoupledRow {
 public:
  CoupledRow(const joints::JointSpec& spec, joints::JointType type, MarkerFinder& find)
      : find_(find), what_(fmt::format("joint \"{}\"", spec.name)), where_(spec.where) {
    joint_.name = spec.name;
    joint_.type = type;
    joint_.where = spec.where;
  }

  void take(int index, joints::CoordinateTerm term) {
    const Model& model = find_.model();
    const Coordinate& coordinate = model.coordinates[static_cast<std::size_t>(index)];
    const Joint& owner = model.joints[static_cast<std::size_t>(coordinate.joint)];
    const bool turns = coordinate.law.is_angle();
    // A force along a beam acts at its nodes.
    if (!owner.track) find_.require_moment(owner.first, what_, where_);
    if (turns) find_.require_moment(owner.second, what_, where_);
    if (joint_.coupled.empty()) {
      joint_.first = owner.first;
      joint_.second = owner.second;
      joint_.axis_F = owner.axis_F;
      is_length_ = !turns;
    }
    joint_.coupled.push_back({index, std::move(term)});
  }

  /// @param law of the sum, zero if absent
  void add(std::optional<base::TimeLaw> law) {
    joint_.rows.push_back(joints::ConstraintRow::coupled(is_length_, std::move(law)));
    joint_.first_row = find_.model().num_constraint_rows();
    find_.model().joints.push_back(std::move(joint_));
  }

  const std::string& what() const { return what_; }

 private:
  MarkerFinder& find_;
  std::string what_;
  SourceLocation where_;
  Joint joint_;
  bool is_length_ = true;
};

}  // namespace

void add_coupler(const joints::JointSpec& spec, MarkerFinder& find) {
  CoupledRow row(spec, joints::JointType::coupler, find);
  for (const joints::CouplerTermSpec& term : std::get<joints::CouplerSpec>(spec.kind).of) {
    row.take(coordinate_of(term.name, term.which, base::CoordinateSort::any, spec, find),
             term_of(term, row.what()));
  }
  row.add(std::nullopt);
}

void add_coordinate_drive(const joints::JointSpec& spec, MarkerFinder& find) {
  const auto& drive = std::get<joints::PrescribedCoordinateSpec>(spec.kind);
  CoupledRow row(spec, joints::JointType::prescribed_coordinate, find);
  row.take(coordinate_of(drive.joint, drive.which, drive.sort(), spec, find), {});
  // Those that follow signals get them when these are known, see add_drives().
  row.add(drive.laws().is_steered() ? base::TimeLaw() : drive.laws().of_time());
}

}  // namespace buckens::model
