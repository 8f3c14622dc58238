// SPDX-License-Identifier: Apache-2.0
#include "buckens/base/units.h"

#include <cmath>

#include <gtest/gtest.h>

#include "buckens/base/nearest.h"

namespace buckens::base {
namespace {

TEST(Units, SimpleUnitsAndProducts) {
  const struct {
    const char* text;
    double factor;
    Dimension dimension;
  } cases[] = {{"mm", 1e-3, kLength},
               {"GPa", 1e9, kStress},
               {"kg m^2", 1, kInertia},
               {"kg*m^2", 1, kInertia},
               {"kg·m²", 1, kInertia},
               {"g mm^2", 1e-9, kInertia},
               {"m/s^2", 1, kAcceleration},
               {"m/s/s", 1, kAcceleration},
               {"kg/m^3", 1, kDensity},
               {"N/m", 1, kStiffness},
               {"N/mm", 1e3, kStiffness},
               {"N*s/m", 1, kDamping},
               {"N m/rad", 1, kRotationalStiffness},
               {"N m s/rad", 1, kRotationalDamping},
               {"N m/deg", 180 / M_PI, kRotationalStiffness},
               {"kN", 1e3, kForce},
               {"deg", M_PI / 180, kAngle},
               {"°", M_PI / 180, kAngle},
               {"rpm", 2 * M_PI / 60, kAngularVelocity},
               {"1/s", 1, kFrequency},
               {"Hz", 1, kFrequency},
               {"s^-1", 1, kFrequency},
               {"%", 0.01, kNumber},
               {"mm^4", 1e-12, kSecondMoment}};
  for (const auto& c : cases) {
    const auto unit = parse_unit(c.text);
    ASSERT_TRUE(unit) << c.text;
    EXPECT_DOUBLE_EQ(unit->factor, c.factor) << c.text;
    EXPECT_EQ(unit->dimension, c.dimension) << c.text;
  }
}

TEST(Units, WhatIsNoUnit) {
  for (const char* text : {"", "x", "mmm", "m^", "m^0", "kg/m s", "m/", "/s", "1", "2", "m s^x",
                           "m^99", "kg m^2)", "* m", "1 m"}) {
    EXPECT_FALSE(parse_unit(text)) << text;
  }
  EXPECT_FALSE(parse_unit(std::string(100000, 'm')));
}

TEST(Units, TheRadianMattersOnlyWithoutMass) {
  EXPECT_TRUE(accepts(kRotationalStiffness, kTorque));
  EXPECT_TRUE(accepts(kTorque, kRotationalStiffness));
  EXPECT_FALSE(accepts(kAngularVelocity, kFrequency));
  EXPECT_FALSE(accepts(kFrequency, kAngularVelocity));
  EXPECT_FALSE(accepts(kAngle, kNumber));
  EXPECT_FALSE(accepts(kForce, kTorque));
}

TEST(Units, TheGreekLetterStandsForMicro) {
  ASSERT_TRUE(parse_unit("\u03bcm"));  // Greek
  EXPECT_EQ(parse_unit("\u03bcm")->factor, parse_unit("\u00b5m")->factor);
  EXPECT_EQ(parse_unit("N/\u03bcm")->factor, 1e6);
  EXPECT_FALSE(parse_unit("\u03bc"));
}

TEST(Units, NamesOfDimensions) {
  EXPECT_EQ(si_unit(kRotationalDamping), "N m s/rad");
  EXPECT_EQ(dimension_name(kForce), "a force");
  EXPECT_EQ(si_unit(kMass * kLength), "kg m");
  EXPECT_EQ(si_unit(kNumber / kMass / kTime / kTime), "1/kg/s^2");
  // Every printed unit can be read again.
  for (const auto& d : {kLength,
                        kMass,
                        kTime,
                        kAngle,
                        kArea,
                        kSecondMoment,
                        kVelocity,
                        kAcceleration,
                        kAngularVelocity,
                        kFrequency,
                        kForce,
                        kTorque,
                        kStress,
                        kDensity,
                        kInertia,
                        kStiffness,
                        kDamping,
                        kRotationalStiffness,
                        kRotationalDamping,
                        kMass * kLength}) {
    ASSERT_TRUE(parse_unit(si_unit(d))) << si_unit(d);
    EXPECT_EQ(parse_unit(si_unit(d))->dimension, d) << si_unit(d);
  }
}

TEST(Quantity, TheUnitIsTheEndingAfterWhiteSpace) {
  const struct {
    const char *text, *formula, *unit;
  } cases[] = {{"75 mm", "75", "mm"},
               {"75mm", "75", "mm"},
               {"5%", "5", "%"},
               {"-2.727e-3 kg m^2", "-2.727e-3", "kg m^2"},
               {"10*sin(20*t) N m", "10*sin(20*t)", "N m"},
               {"0.5 * L", "0.5 * L", ""},
               {"L / 2 mm", "L / 2", "mm"},
               {"2 1/s", "2", "1/s"},
               {"a - 1/s", "a - 1/s", ""},
               {"2*m", "2*m", ""},
               {"3 * m", "3 * m", ""},
               {"9.81 m/s^2", "9.81", "m/s^2"},
               {"  4  ", "4", ""},
               {"2e3", "2e3", ""},
               {"3 foo", "3 foo", ""},
               {"3 kg/m s", "3 kg/m s", ""},
               {"", "", ""}};
  for (const auto& c : cases) {
    const QuantityText split = split_quantity(c.text);
    EXPECT_EQ(split.formula, c.formula) << c.text;
    EXPECT_EQ(split.unit, c.unit) << c.text;
  }
}

TEST(Number, OnlyPlainDecimals) {
  EXPECT_EQ(parse_number("10"), 10);
  EXPECT_EQ(parse_number("+1.5e-3"), 1.5e-3);
  EXPECT_EQ(parse_number("-.5"), -0.5);
  EXPECT_EQ(parse_number("0.5"), 0.5);
  EXPECT_EQ(parse_number("0"), 0);
  EXPECT_EQ(parse_number("5."), 5);
  for (const char* text : {"010", "-010", "0x10", "1_000", "yes", ".inf", "nan", "inf", "1e999", "",
                           "1 2", "1,5", "--1", "1e", "e5", "."}) {
    EXPECT_FALSE(parse_number(text)) << text;
  }
}

TEST(Nearest, FindsSlipsOfThePen) {
  EXPECT_EQ(edit_distance("elemnts", "elements"), 1);
  EXPECT_EQ(edit_distance("setp", "step"), 1);
  EXPECT_EQ(edit_distance("Mass", "mass"), 0);
  EXPECT_EQ(nearest("mas", {"mass", "com", "inertia"}), "mass");
  EXPECT_EQ(nearest("youngs", {"mass", "com"}), "");
  EXPECT_EQ(nearest("a", {"b", "c"}), "");
  EXPECT_EQ(suggestion("q", {"left", "right"}), " Known are: left, right.");
  EXPECT_EQ(suggestion("lefft", {"left", "right"}), " Did you mean \"left\"?");
  EXPECT_EQ(suggestion("x", {}), "");
  const std::string many = suggestion("x", std::vector<std::string>(80, "abcdef"));
  EXPECT_TRUE(many.ends_with("abcdef and 20 more.")) << many;
  const std::string all = suggestion("x", std::vector<std::string>(20, "abcdef"));
  EXPECT_TRUE(all.ends_with("abcdef.")) << all;
}

}  // namespace
}  // namespace buckens::base
