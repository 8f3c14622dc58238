// SPDX-License-Identifier: Apache-2.0
#include "buckens/base/dimension.h"

#include <array>
#include <cstdlib>
#include <utility>

#include "buckens/base/motion_dimensions.h"

namespace buckens::base {

namespace {

struct KnownDimension {
  Dimension dimension;
  const char* unit;
  const char* name;
};

constexpr std::array<KnownDimension, 21> kKnown = {{
    {kNumber, "", "a pure number"},
    {kLength, "m", "a length"},
    {kMass, "kg", "a mass"},
    {kTime, "s", "a time"},
    {kAngle, "rad", "an angle"},
    {kArea, "m^2", "an area"},
    {kVolume, "m^3", "a volume"},
    {kSecondMoment, "m^4", "a second moment of area"},
    {kVelocity, "m/s", "a velocity"},
    {kAcceleration, "m/s^2", "an acceleration"},
    {kAngularVelocity, "rad/s", "an angular velocity"},
    {kAngularAcceleration, "rad/s^2", "an angular acceleration"},
    {kFrequency, "Hz", "a frequency"},
    {kForce, "N", "a force"},
    {kTorque, "N m", "a torque"},
    {kPower, "W", "a power"},
    {kStress, "Pa", "a stress"},
    {kDensity, "kg/m^3", "a density"},
    {kInertia, "kg m^2", "a moment of inertia"},
    {kStiffness, "N/m", "a stiffness or force per length"},
    {kDamping, "N s/m", "a damping constant"},
}};
constexpr std::array<KnownDimension, 2> kKnownRotational = {{
    {kRotationalStiffness, "N m/rad", "a rotational stiffness"},
    {kRotationalDamping, "N m s/rad", "a rotational damping constant"},
}};

const KnownDimension* find(const Dimension& dimension) {
  for (const auto& known : kKnown) {
    if (known.dimension == dimension) return &known;
  }
  for (const auto& known : kKnownRotational) {
    if (known.dimension == dimension) return &known;
  }
  return nullptr;
}

}  // namespace

std::string si_unit(const Dimension& dimension) {
  if (const auto* known = find(dimension)) return known->unit;
  const std::array<std::pair<const char*, int>, 4> factors = {{{"kg", dimension.mass},
                                                               {"m", dimension.length},
                                                               {"s", dimension.time},
                                                               {"rad", dimension.angle}}};
  std::string above, below;
  for (const auto& [unit, exponent] : factors) {
    if (exponent == 0) continue;
    std::string factor = unit;
    if (std::abs(exponent) > 1) factor += "^" + std::to_string(std::abs(exponent));
    if (exponent > 0) {
      above += (above.empty() ? "" : " ") + factor;
    } else {
      below += "/" + factor;
    }
  }
  return (above.empty() ? "1" : above) + below;
}

std::string dimension_name(const Dimension& dimension) {
  if (const auto* known = find(dimension)) return known->name;
  return "a quantity in " + si_unit(dimension);
}

}  // namespace buckens::base
