// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "buckens/base/field.h"
#include "buckens/base/marker_ref.h"

namespace buckens::loads {

/// An elastic belt that slips, over two pulleys held by their own joints.
struct ElasticBeltSpec {
  static constexpr const char* kKey = "elastic-belt";
  static constexpr const char* kDoc =
      "belt over two pulleys with parallel axes, markers at their centres: elastic spans with "
      "pretension pull at the shafts, and the belt slips by the capstan law";
  std::array<base::MarkerRef, 2> between;
  std::optional<Eigen::Vector3d> axis;  ///< in the first marker
  std::array<double, 2> radii{0, 0};    ///< [m]
  bool crossed = false;
  double stiffness = 0;               ///< E A [N]
  double damping_time = 0;            ///< [s]
  double pretension = 0;              ///< [N]
  std::optional<double> coefficient;  ///< of friction

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("between", between, "the markers at the centres of the pulleys")
              .required()
              .like("[driver, driven]"));
    visit(base::field("axis", axis, "of both pulleys, in the first marker's axes")
              .like("[0, 0, 1]")
              .otherwise("planar models: the normal of the plane"));
    visit(base::field("radii", radii, "of the first and second pulley")
              .in(base::kLength)
              .positive()
              .required()
              .like("[50 mm, 120 mm]"));
    visit(base::field("crossed", crossed, "whether the pulleys turn against each other").on_off());
    visit(base::field("stiffness", stiffness, "E A of the belt: force per strain")
              .in(base::kForce)
              .positive()
              .required()
              .like("50 kN"));
    visit(base::field("damping-time", damping_time,
                      "the belt resists its rate of strain with E A times this")
              .in(base::kTime)
              .non_negative()
              .like("1 ms"));
    visit(base::field("pretension", pretension, "force in both spans as placed")
              .in(base::kForce)
              .non_negative()
              .like("200 N"));
    visit(base::field("friction", coefficient,
                      "coefficient between belt and pulleys: the tensions of both spans differ by "
                      "no more than the factor exp(friction x wrap) of either pulley")
              .non_negative()
              .like("0.3")
              .otherwise("it does not slip, as a toothed belt or chain"));
  }
};

}  // namespace buckens::loads
