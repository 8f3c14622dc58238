// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "buckens/base/field.h"
#include "buckens/base/marker_ref.h"
#include "buckens/base/path_spec.h"

namespace buckens::loads {

/// A side of a curve, seen along it.
enum class CurveSide { left, right };

constexpr std::array<const char*, 2> choice_names(CurveSide) { return {"left", "right"}; }

/// Keeps a roller on one side of a curve: rigidly, or with a stiffness.
struct CamSpec : base::PathSpec {
  static constexpr const char* kKey = "cam";
  static constexpr const char* kDoc =
      "plane curve fixed in the first body that pushes a roller, or a point, at the second marker "
      "without friction and never pulls: the follower can lift off";
  std::array<base::MarkerRef, 2> between;
  std::optional<Eigen::Vector3d> normal;  ///< in the first marker
  double roller = 0;                      ///< radius [m]
  std::optional<CurveSide> side;
  std::optional<double> stiffness;    ///< [N/m]
  double damping = 0;                 ///< [N s/m]
  std::optional<double> restitution;  ///< 0 … 1
  std::optional<double> threshold;    ///< [m/s]

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("between", between, "the markers of the curve and of the follower")
              .required()
              .like("[cam, follower/roller]"));
    path_fields(visit);
    visit(base::field("normal", normal, "across the plane of the curve, in the first marker's axes")
              .like("[0, 0, 1]")
              .otherwise("planar models: the normal of the plane"));
    visit(base::field("roller", roller, "radius of the roller, whose centre the second marker is")
              .in(base::kLength)
              .non_negative()
              .like("8 mm"));
    visit(base::field("side", side,
                      "on which the follower is, seen along the curve with `normal` upwards")
              .like("right")
              .otherwise("outside of a closed curve, to the left of an open one"));
    visit(base::field("stiffness", stiffness, "of an elastic contact")
              .in(base::kStiffness)
              .positive()
              .like("1e7 N/m")
              .otherwise("the contact is rigid"));
    visit(base::field("damping", damping,
                      "of an elastic contact; its force is at most that of the stiffness")
              .in(base::kDamping)
              .non_negative()
              .like("2 kN s/m"));
    visit(base::field("restitution", restitution,
                      "coefficient of restitution when a rigid follower comes back, 0 … 1")
              .non_negative()
              .like("0.2")
              .otherwise("0: it stays until it is lifted off"));
    visit(base::field("threshold", threshold, "speed up to which it causes no rebound")
              .in(base::kVelocity)
              .positive()
              .like("1 mm/s")
              .otherwise("a thousandth of the model's size per second"));
  }
};

}  // namespace buckens::loads
