// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

namespace buckens::base {

/// A joint coordinate by name: `which` of laws, sensors, signals and couplers.
enum class CoordinateChoice { angle, displacement, second_angle, x, y, z, swing, twist };

inline constexpr std::size_t kNumCoordinateChoices = 8;

constexpr std::array<const char*, kNumCoordinateChoices> choice_names(CoordinateChoice) {
  return {"angle", "displacement", "second-angle", "x", "y", "z", "swing", "twist"};
}

/// Properties of a coordinate that do not depend on its joint.
struct CoordinateName {
  CoordinateChoice which;
  bool is_angle;         ///< [rad], or a displacement [m]
  const char* key;       ///< in model files
  const char* text;      ///< in sentences
  const char* rate_key;  ///< of its rate, where a motion starts
};

inline constexpr std::array<CoordinateName, kNumCoordinateChoices> kCoordinateNames{{
    {CoordinateChoice::angle, true, "angle", "angle", "speed"},
    {CoordinateChoice::displacement, false, "displacement", "displacement", "velocity"},
    {CoordinateChoice::second_angle, true, "second-angle", "second angle", "second-speed"},
    {CoordinateChoice::x, false, "x", "displacement x", "x-velocity"},
    {CoordinateChoice::y, false, "y", "displacement y", "y-velocity"},
    {CoordinateChoice::z, false, "z", "displacement z", "z-velocity"},
    {CoordinateChoice::swing, true, "swing", "swing", "swing-speed"},
    {CoordinateChoice::twist, true, "twist", "twist", "twist-speed"},
}};

constexpr const CoordinateName& name_of(CoordinateChoice which) {
  return kCoordinateNames[static_cast<std::size_t>(which)];
}

/// The joint coordinates that an element accepts.
enum class CoordinateSort { any, angles, displacements };

constexpr bool is_of(CoordinateChoice which, CoordinateSort sort) {
  return sort == CoordinateSort::any || name_of(which).is_angle == (sort == CoordinateSort::angles);
}

/// Selects a coordinate: the requested one; otherwise the angle, the displacement, or the only one
/// of its type.
/// @param offered coordinates of the joint. @return nothing if there is none, or more than one
constexpr std::optional<CoordinateChoice> meant(std::span<const CoordinateChoice> offered,
                                                std::optional<CoordinateChoice> asked,
                                                CoordinateSort sort) {
  std::optional<CoordinateChoice> only;
  int count = 0;
  for (const CoordinateChoice which : offered) {
    if (!is_of(which, sort) || (asked && *asked != which)) continue;
    if (asked || which == CoordinateChoice::angle || which == CoordinateChoice::displacement) {
      return which;
    }
    only = which;
    ++count;
  }
  return count == 1 ? only : std::nullopt;
}

}  // namespace buckens::base
