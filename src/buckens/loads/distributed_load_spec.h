// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>

#include "buckens/base/field.h"
#include "buckens/base/source_location.h"
#include "buckens/base/time_law.h"
#include "buckens/loads/load_axes.h"
#include "buckens/loads/load_fields.h"

namespace buckens::loads {

inline constexpr base::Dimension kForcePerLength = base::kForce / base::kLength;
inline constexpr base::Dimension kForcePerVolume = base::kForce / base::kVolume;

/// Part of a body on which a load acts: "piston/crown", or a whole body: "rotor".
struct BodyPart {
  SourceLocation where;
  std::string text;  ///< as written

  std::string body() const { return text.substr(0, text.find('/')); }
  /// The part after the slash; empty: the whole body.
  std::string part() const {
    const std::size_t slash = text.find('/');
    return slash == std::string::npos ? "" : text.substr(slash + 1);
  }

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("name", text, "body, or body and part separated by a slash")
              .required()
              .shorthand()
              .like("piston/crown"));
  }
};

/// Pressure on faces along the normals of the undeformed mesh, in body axes.
struct PressureSpec {
  static constexpr const char* kKey = "pressure";
  static constexpr const char* kDoc = "pressure on faces of a mesh; positive pushes against them";
  BodyPart on;
  base::TimeLaw value;  ///< [Pa]
  std::string factor;   ///< name of a signal; empty: none

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(
        part_field(on, "body and one of its named faces, face sets or interfaces", "piston/crown"));
    visit(base::field("value", value, "pressure, a number or a law of time")
              .in(base::kStress)
              .required()
              .like("{table: gas.csv, unit: bar}"));
    visit(factor_field(factor));
  }
};

/// Force per area on faces.
struct TractionSpec {
  static constexpr const char* kKey = "traction";
  static constexpr const char* kDoc = "force per area on faces of a mesh";
  BodyPart on;
  std::array<base::TimeLaw, 3> value;  ///< [Pa]
  LoadAxes axes = LoadAxes::fixed;
  std::string factor;  ///< name of a signal; empty: none

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(part_field(on, "body and one of its named faces, face sets or interfaces", "plate/z1"));
    visit(components_field("value", value, base::kStress, "[2 kPa, 0, 0]").required());
    visit(axes_field(axes, "body"));
    visit(factor_field(factor));
  }
};

/// Force per length on beams and bars.
struct LineLoadSpec {
  static constexpr const char* kKey = "line-load";
  static constexpr const char* kDoc = "force per length on beams and bars";
  BodyPart on;
  std::array<base::TimeLaw, 3> value;  ///< [N/m]
  LoadAxes axes = LoadAxes::fixed;
  std::string factor;  ///< name of a signal; empty: none

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(part_field(on,
                     "body of beams; after a slash an element set or the number of a beam in "
                     "`beams`, counted from 1",
                     "girder"));
    visit(components_field("value", value, kForcePerLength, "[0, 0, -500 N/m]").required());
    visit(axes_field(axes, "body"));
    visit(factor_field(factor));
  }
};

/// Force per mass or per volume. Exactly one of the two is given.
struct BodyForceSpec {
  static constexpr const char* kKey = "body-force";
  static constexpr const char* kDoc = "force per mass or per volume on a body or a set of elements";
  BodyPart on;
  std::optional<std::array<base::TimeLaw, 3>> per_mass;    ///< [m/s²]
  std::optional<std::array<base::TimeLaw, 3>> per_volume;  ///< [N/m³]
  LoadAxes axes = LoadAxes::fixed;
  std::string factor;  ///< name of a signal; empty: none

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(part_field(on, "body; after a slash an element set or the number of a beam", "rotor"));
    visit(components_field("per-mass", per_mass, base::kAcceleration, "[0, 2 m/s^2, 0]")
              .otherwise("give this or `per-volume`"));
    visit(components_field("per-volume", per_volume, kForcePerVolume, "[0, 5 kN/m^3, 0]")
              .otherwise("give this or `per-mass`"));
    visit(axes_field(axes, "body"));
    visit(factor_field(factor));
  }
};

/// An accelerating base to which the world is fixed: all bodies are subject to −a per mass.
struct BaseAccelerationSpec {
  static constexpr const char* kKey = "base-acceleration";
  static constexpr const char* kDoc =
      "translational acceleration of the ground in an inertial frame; everything is reported "
      "relative to the ground, and every body is subject to the opposite force per mass";
  std::array<base::TimeLaw, 3> value;  ///< [m/s²]

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(components_field("value", value, base::kAcceleration, "[\"5*sin(30*t) m/s^2\", 0, 0]")
              .required());
  }
};

}  // namespace buckens::loads
