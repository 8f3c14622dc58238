// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "buckens/base/field.h"
#include "buckens/base/marker_ref.h"
#include "buckens/base/source_location.h"

namespace buckens::loads {

/// Side of a cable on which a pulley is, seen along the cable and against the axis.
enum class PulleySide { left, right };

constexpr std::array<const char*, 2> choice_names(PulleySide) { return {"left", "right"}; }

/// A pulley that a cable wraps.
struct CablePulleySpec {
  SourceLocation where;
  base::MarkerRef on;
  double radius = 0;  ///< [m]
  PulleySide side = PulleySide::left;
  int turns = 0;
  std::optional<double> coefficient;  ///< of friction, in place of the cable's

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("on", on, "marker at the centre of the pulley, on the body that turns")
              .required()
              .like("sheave"));
    visit(base::field("radius", radius, "of the pulley, to the middle of the cable")
              .in(base::kLength)
              .required()
              .positive()
              .like("80 mm"));
    visit(base::field("side", side,
                      "where the pulley is, going along the cable and looking against the axis: "
                      "around one to the left it runs counter-clockwise"));
    visit(base::field("turns", turns, "whole turns around the pulley in addition").non_negative());
    visit(
        base::field("friction", coefficient,
                    "coefficient between cable and this pulley; 0 for sheaves that turn freely and "
                    "are no bodies of their own")
            .non_negative()
            .like("0")
            .otherwise("that of the cable"));
  }
};

/// A cable over any number of pulleys, with fixed ends or closed.
struct CableSpec {
  static constexpr const char* kKey = "cable";
  static constexpr const char* kDoc =
      "cable, or closed belt, over any number of pulleys with parallel axes, in the order in which "
      "it runs around them: elastic spans that only pull, get longer and shorter as the pulleys "
      "turn and move, and slip by the capstan law";
  std::optional<std::array<base::MarkerRef, 2>> ends;
  std::vector<CablePulleySpec> pulleys;
  std::optional<Eigen::Vector3d> axis;  ///< in the first pulley's marker
  double stiffness = 0;                 ///< E A [N]
  double damping_time = 0;              ///< [s]
  double pretension = 0;                ///< [N]
  std::optional<double> coefficient;    ///< of friction

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("pulleys", pulleys, "what it runs around, in this order")
              .required()
              .like("[{on: upper, radius: 80 mm}, {on: lower, radius: 60 mm}]"));
    visit(base::field("ends", ends,
                      "the markers on which it begins and ends; where that is the marker of the "
                      "first or last pulley, it is fixed to its rim: a drum")
              .like("[ground, hook]")
              .otherwise("none: it is closed, and goes from the last pulley to the first"));
    visit(base::field("axis", axis, "of all pulleys, in the axes of the first one's marker")
              .like("[0, 0, 1]")
              .otherwise("planar models: the normal of the plane"));
    visit(base::field("stiffness", stiffness, "E A of the cable: force per strain")
              .in(base::kForce)
              .positive()
              .required()
              .like("1 MN"));
    visit(base::field("damping-time", damping_time,
                      "the cable resists its rate of strain with E A times this")
              .in(base::kTime)
              .non_negative()
              .like("1 ms"));
    visit(base::field("pretension", pretension, "force in all spans as placed")
              .in(base::kForce)
              .non_negative()
              .like("200 N"));
    visit(base::field("friction", coefficient,
                      "coefficient between cable and pulleys: the tensions on both sides of a "
                      "pulley differ by no more than the factor exp(friction x wrap); 0: the same "
                      "on both sides")
              .non_negative()
              .like("0.3")
              .otherwise("it does not slip"));
  }
};

}  // namespace buckens::loads
