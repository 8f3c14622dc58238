// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "buckens/base/field.h"
#include "buckens/base/source_location.h"

namespace buckens::fem {

struct CircleSpec {
  static constexpr const char* kKey = "circle";
  static constexpr const char* kDoc = "solid circle";
  double diameter = 0;  ///< [m]

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("diameter", diameter, "diameter")
              .in(base::kLength)
              .required()
              .positive()
              .like("6 mm"));
  }
};

/// Circular hollow section. Exactly one of thickness and inner diameter is given.
struct TubeSpec {
  static constexpr const char* kKey = "tube";
  static constexpr const char* kDoc = "circular hollow section";
  double outer_diameter = 0;             ///< [m]
  std::optional<double> thickness;       ///< [m]
  std::optional<double> inner_diameter;  ///< [m]

  double inner() const {
    return inner_diameter ? *inner_diameter : outer_diameter - 2.0 * thickness.value_or(0.0);
  }

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("outer-diameter", outer_diameter, "outer diameter")
              .in(base::kLength)
              .required()
              .positive()
              .like("40 mm"));
    visit(base::field("thickness", thickness, "wall thickness")
              .in(base::kLength)
              .positive()
              .like("3 mm")
              .otherwise("give this or `inner-diameter`"));
    visit(base::field("inner-diameter", inner_diameter, "inner diameter")
              .in(base::kLength)
              .positive()
              .like("34 mm")
              .otherwise("give this or `thickness`"));
  }
};

struct RectangleSpec {
  static constexpr const char* kKey = "rectangle";
  static constexpr const char* kDoc = "solid rectangle";
  double width = 0;   ///< along the local y axis [m]
  double height = 0;  ///< along the local z axis [m]

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("width", width, "extent along the local y axis")
              .in(base::kLength)
              .required()
              .positive()
              .like("20 mm"));
    visit(base::field("height", height, "extent along the local z axis (the `up` direction)")
              .in(base::kLength)
              .required()
              .positive()
              .like("40 mm"));
  }
};

/// Rectangular hollow section, outer measures.
struct BoxSpec {
  static constexpr const char* kKey = "box";
  static constexpr const char* kDoc = "rectangular hollow section";
  double width = 0;      ///< along the local y axis [m]
  double height = 0;     ///< along the local z axis [m]
  double thickness = 0;  ///< of all walls [m]

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("width", width, "outer extent along the local y axis")
              .in(base::kLength)
              .required()
              .positive()
              .like("40 mm"));
    visit(base::field("height", height, "outer extent along the local z axis (the `up` direction)")
              .in(base::kLength)
              .required()
              .positive()
              .like("60 mm"));
    visit(base::field("thickness", thickness, "wall thickness, less than half of width and height")
              .in(base::kLength)
              .required()
              .positive()
              .like("3 mm"));
  }
};

/// Section given by its constants, in principal axes through the centroid.
struct GeneralSectionSpec {
  static constexpr const char* kKey = "general";
  static constexpr const char* kDoc = "any section, given by its constants";
  double A = 0;   ///< [m²]
  double Iy = 0;  ///< ∫ z² dA [m⁴]
  double Iz = 0;  ///< ∫ y² dA [m⁴]
  double J = 0;   ///< torsion constant [m⁴]
  double shear_factor_y = 1;
  double shear_factor_z = 1;
  std::vector<std::array<double, 2>> stress_points;  ///< (y, z) [m]; empty: a rectangle's

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("A", A, "area").in(base::kArea).required().positive().like("300 mm^2"));
    visit(base::field("Iy", Iy, "second moment ∫ z² dA, bending in the local x-z plane")
              .in(base::kSecondMoment)
              .required()
              .positive()
              .like("4e4 mm^4"));
    visit(base::field("Iz", Iz, "second moment ∫ y² dA, bending in the local x-y plane")
              .in(base::kSecondMoment)
              .required()
              .positive()
              .like("1e4 mm^4"));
    visit(base::field("J", J, "torsion constant")
              .in(base::kSecondMoment)
              .required()
              .positive()
              .like("2e4 mm^4"));
    visit(base::field("shear-factor-y", shear_factor_y,
                      "shear correction factor along y (Timoshenko)")
              .positive()
              .like("0.85"));
    visit(base::field("shear-factor-z", shear_factor_z,
                      "shear correction factor along z (Timoshenko)")
              .positive()
              .like("0.85"));
    visit(base::field("stress-points", stress_points,
                      "points (y, z) where bending stress is evaluated")
              .in(base::kLength)
              .like("[[10 mm, 5 mm], [-10 mm, -5 mm]]")
              .otherwise("corners of a rectangle with the same A, Iy, Iz"));
  }
};

/// Cross-section of a beam or bar. Local axes: x along the member, z towards `up`, y = z × x.
struct SectionSpec {
  std::string name;
  SourceLocation where;
  std::variant<CircleSpec, TubeSpec, RectangleSpec, BoxSpec, GeneralSectionSpec> shape;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::inlined(shape, "shape of the section").required());
  }
};

}  // namespace buckens::fem
