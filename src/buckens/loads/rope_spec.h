// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "buckens/base/field.h"
#include "buckens/base/marker_ref.h"

namespace buckens::loads {

/// Limits the distance of two markers to its length, rigidly or with a stiffness.
struct RopeSpec {
  static constexpr const char* kKey = "rope";
  static constexpr const char* kDoc =
      "rope without mass between two markers: holds them no further apart than its length, and "
      "never pushes";
  std::array<base::MarkerRef, 2> between;
  std::optional<double> length;       ///< [m]; default: the distance as placed
  std::optional<double> stiffness;    ///< [N/m]
  double damping = 0;                 ///< [N s/m]
  std::optional<double> restitution;  ///< of a rigid rope, 0 … 1
  std::optional<double> threshold;    ///< [m/s]

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("between", between, "the two markers").required().like("[ground, load/top]"));
    visit(base::field("length", length, "at which the rope is taut")
              .in(base::kLength)
              .positive()
              .like("2 m")
              .otherwise("the distance as placed"));
    visit(base::field("stiffness", stiffness, "force per elongation of an elastic rope")
              .in(base::kStiffness)
              .positive()
              .like("500 kN/m")
              .otherwise("the rope does not stretch"));
    visit(base::field("damping", damping,
                      "of an elastic rope; its force is at most that of the stiffness")
              .in(base::kDamping)
              .non_negative()
              .like("2 kN s/m"));
    visit(base::field(
              "restitution", restitution,
              "coefficient of restitution when a rope that does not stretch becomes taut, 0 … 1")
              .non_negative()
              .like("0.2")
              .otherwise("0: it stays taut until it is relieved"));
    visit(base::field("threshold", threshold, "speed up to which it causes no rebound")
              .in(base::kVelocity)
              .positive()
              .like("1 mm/s")
              .otherwise("a thousandth of the length per second"));
  }
};

}  // namespace buckens::loads
