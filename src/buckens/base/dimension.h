// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace buckens::base {

/// Physical dimension as exponents of length, mass, time and angle.
///
/// Angle is a separate dimension, so that degrees, rpm and hertz cannot be confused; accepts()
/// states where a missing radian does not matter.
struct Dimension {
  int length = 0;
  int mass = 0;
  int time = 0;
  int angle = 0;

  friend constexpr bool operator==(const Dimension&, const Dimension&) = default;

  constexpr Dimension operator*(const Dimension& other) const {
    return {length + other.length, mass + other.mass, time + other.time, angle + other.angle};
  }
  constexpr Dimension operator/(const Dimension& other) const {
    return {length - other.length, mass - other.mass, time - other.time, angle - other.angle};
  }
};

inline constexpr Dimension kNumber{};
inline constexpr Dimension kLength{1, 0, 0, 0};
inline constexpr Dimension kMass{0, 1, 0, 0};
inline constexpr Dimension kTime{0, 0, 1, 0};
inline constexpr Dimension kAngle{0, 0, 0, 1};
inline constexpr Dimension kArea{2, 0, 0, 0};
inline constexpr Dimension kSecondMoment{4, 0, 0, 0};  ///< of an area
inline constexpr Dimension kVolume{3, 0, 0, 0};
inline constexpr Dimension kVelocity{1, 0, -1, 0};
inline constexpr Dimension kAcceleration{1, 0, -2, 0};
inline constexpr Dimension kAngularVelocity{0, 0, -1, 1};
inline constexpr Dimension kFrequency{0, 0, -1, 0};
inline constexpr Dimension kForce{1, 1, -2, 0};
inline constexpr Dimension kTorque{2, 1, -2, 0};
inline constexpr Dimension kStress{-1, 1, -2, 0};
inline constexpr Dimension kDensity{-3, 1, 0, 0};
inline constexpr Dimension kInertia{2, 1, 0, 0};  ///< rotary inertia
inline constexpr Dimension kStiffness{0, 1, -2, 0};
inline constexpr Dimension kDamping{0, 1, -1, 0};
inline constexpr Dimension kRotationalStiffness{2, 1, -2, -1};
inline constexpr Dimension kRotationalDamping{2, 1, -1, -1};

/// True if a quantity of dimension `given` is acceptable where `expected` is required: the same
/// exponents; that of the angle may differ only where a mass is involved (N m for N m/rad).
constexpr bool accepts(const Dimension& expected, const Dimension& given) {
  if (expected == given) return true;
  return expected.mass != 0 && expected.length == given.length && expected.mass == given.mass &&
         expected.time == given.time;
}

/// SI unit as printed in messages: "kg m^2", "N/m", "rad/s"; empty for pure numbers.
std::string si_unit(const Dimension& dimension);

/// Name for messages: "a length", "a force"; "a quantity in kg m" if there is no name.
std::string dimension_name(const Dimension& dimension);

}  // namespace buckens::base
