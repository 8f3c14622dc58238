// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <numbers>
#include <optional>

#include "buckens/base/field.h"
#include "buckens/base/marker_ref.h"

namespace buckens::loads {

/// Two gears with elastic teeth and backlash, held by their own joints.
struct ElasticGearSpec {
  static constexpr const char* kKey = "elastic-gear";
  static constexpr const char* kDoc =
      "two gears with parallel axes, markers at their centres: elastic teeth with backlash, which "
      "carry on either flank or on none";
  std::array<base::MarkerRef, 2> between;
  std::optional<Eigen::Vector3d> axis;  ///< in the first marker
  std::array<double, 2> teeth{0, 0};
  bool internal = false;
  double pressure_angle = std::numbers::pi / 9;  ///< [rad]
  double helix_angle = 0;                        ///< [rad]
  double stiffness = 0;                          ///< [N/m]
  double damping = 0;                            ///< [N s/m]
  double backlash = 0;                           ///< [m]

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("between", between, "the markers at the centres of the gears")
              .required()
              .like("[pinion, wheel]"));
    visit(base::field("axis", axis, "of both gears, in the first marker's axes")
              .like("[0, 0, 1]")
              .otherwise("planar models: the normal of the plane"));
    visit(
        base::field("teeth", teeth,
                    "numbers of teeth of the first and second gear; pitch circles follow from the "
                    "distance of the centres as placed")
            .positive()
            .required()
            .like("[20, 40]"));
    visit(base::field("internal", internal, "whether the gear with more teeth is a ring").on_off());
    visit(base::field("pressure-angle", pressure_angle,
                      "normal to the teeth: how much of their force pushes the shafts apart")
              .in(base::kAngle)
              .non_negative()
              .like("20 deg")
              .otherwise("20 deg"));
    visit(base::field("helix-angle", helix_angle,
                      "of the teeth; positive: those of the first gear are right-handed")
              .in(base::kAngle)
              .like("15 deg"));
    visit(base::field("stiffness", stiffness,
                      "of the teeth in contact, normal to their flanks, its mean over the mesh")
              .in(base::kStiffness)
              .positive()
              .required()
              .like("2e8 N/m"));
    visit(base::field("damping", damping,
                      "of the teeth in contact; it pushes at most as hard as their spring")
              .in(base::kDamping)
              .non_negative()
              .like("1 kN s/m"));
    visit(base::field("backlash", backlash,
                      "play on the pitch circle; as placed, teeth stand in the middle of it")
              .in(base::kLength)
              .non_negative()
              .like("0.1 mm"));
  }
};

}  // namespace buckens::loads
