// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include <Eigen/Core>

#include "buckens/base/coordinate_choice.h"
#include "buckens/base/field.h"
#include "buckens/base/marker_ref.h"

namespace buckens::joints {

/// Two markers; the joint uses the axes of the first.
struct JointEnds {
  std::array<base::MarkerRef, 2> between;

  template <class Visitor>
  void end_fields(Visitor& visit) {
    visit(base::field("between", between, "the two markers").required().like("[ground, crank]"));
  }
};

struct JointEndsAndAxis : JointEnds {
  std::optional<Eigen::Vector3d> axis;  ///< in the first marker; default for planar: the normal

  template <class Visitor>
  void axis_fields(Visitor& visit) {
    end_fields(visit);
    visit(base::field("axis", axis, "direction of the axis in the first marker's axes")
              .like("[0, 0, 1]")
              .otherwise("planar models: the normal of the plane"));
  }
};

/// Two markers with a required axis.
struct JointEndsAndDirection : JointEnds {
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  ///< in the first marker

  template <class Visitor>
  void direction_fields(Visitor& visit, const char* doc) {
    end_fields(visit);
    visit(base::field("axis", axis, doc).required().like("[1, 0, 0]"));
  }
};

}  // namespace buckens::joints
