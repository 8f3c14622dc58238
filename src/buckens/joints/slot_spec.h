// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "buckens/base/path_spec.h"
#include "buckens/joints/joint_ends.h"

namespace buckens::joints {

struct SlotSpec : JointEnds, base::PathSpec {
  static constexpr const char* kKey = "slot";
  static constexpr const char* kDoc =
      "a point on a curve that is fixed in the first body: a pin in a slot, the centre of a roller "
      "on a cam with its counter cam, a bead on a bent wire; all rotations are free; its "
      "coordinate "
      "is the displacement along the curve, from as placed, over laps of a closed one";
  static constexpr std::array kCoordinates{base::CoordinateChoice::displacement};
  std::optional<Eigen::Vector3d> normal;  ///< in the first marker

  template <class Visitor>
  void fields(Visitor& visit) {
    end_fields(visit);
    path_fields(visit);
    visit(base::field("normal", normal,
                      "of a plane curve: direction across its plane in the first marker's axes, "
                      "along which the second marker may move as well")
              .like("[0, 0, 1]")
              .otherwise("planar models: the normal of the plane; else the point stays on the "
                         "curve in space"));
  }
};

}  // namespace buckens::joints
