// SPDX-License-Identifier: Apache-2.0
#include "buckens/base/characteristic.h"

#include <cmath>

#include <gmock/gmock.h>

#include "buckens/base/errors.h"

namespace buckens::base::test {
namespace {

Characteristic formula(const std::string& text, double scale = 1.0) {
  return Characteristic::formula(Expression(text, {"x", "rate"}, {}, {}), scale);
}

TEST(Characteristic, StoresTheIntegralOfItsForce) {
  const Characteristic law = formula("3*x + 40*x^3 + rate", 2.0);
  for (const double x : {-0.7, -1e-3, 0.0, 0.2, 1.3}) {
    SCOPED_TRACE(x);
    EXPECT_NEAR(law.force(x, 0.5), 2.0 * (3 * x + 40 * x * x * x + 0.5), 1e-12);
    // Quadrature is exact for polynomials of this order; only rounding remains.
    EXPECT_NEAR(law.energy(x), 2.0 * (1.5 * x * x + 10 * std::pow(x, 4)), 1e-12);
    const Characteristic::Slopes slopes = law.slopes(x, 0.5);
    EXPECT_NEAR(slopes.stiffness, 2.0 * (3 + 120 * x * x), 1e-5);
    EXPECT_NEAR(slopes.damping, 2.0, 1e-6);
  }
}

TEST(Characteristic, IntegratesTablesOverTheirCorners) {
  const Characteristic law = Characteristic::table(
      TimeLaw::table({-2.0, -0.3, 0.1, 2.0}, {-5.0, -1.6, 0.4, 0.4}, Interpolation::linear));
  // Linear between -0.3 and 0.1 through -0.1 at 0: slope 5.
  EXPECT_NEAR(law.energy(0.1), 0.1 * 0.5 * (-0.1 + 0.4), 1e-14);
  EXPECT_NEAR(law.energy(1.1), 0.1 * 0.5 * (-0.1 + 0.4) + 0.4, 1e-14);
  EXPECT_NEAR(law.energy(-0.3), 0.3 * 0.5 * (0.1 + 1.6), 1e-14);
  EXPECT_NEAR(law.energy(-1.3), 0.3 * 0.5 * (0.1 + 1.6) + 1.6 + 1.0, 1e-13);
  EXPECT_NEAR(law.slopes(0.05, 3.0).stiffness, 5.0, 1e-12);
  EXPECT_EQ(law.slopes(2.1, 0.0).stiffness, 0.0);
  EXPECT_THROW(law.force(2.1, 0.0), NumericalError);
  EXPECT_THROW(law.energy(-2.1), NumericalError);
}

TEST(Characteristic, IntegratesThroughAZeroThatIsADifference) {
  // Near zero the values are rounding of two that cancel.
  const Characteristic table =
      Characteristic::table(TimeLaw::table({-0.1, 0.1}, {-1.0, 1.0}, Interpolation::linear));
  EXPECT_NEAR(table.energy(0.05), 5.0 * 0.05 * 0.05, 1e-15);
  EXPECT_NEAR(table.energy(-0.05), 5.0 * 0.05 * 0.05, 1e-15);
  EXPECT_NEAR(formula("1000*(x + 0.3) - 300").energy(0.2), 500 * 0.04, 1e-11);
}

TEST(Characteristic, IsZeroUnlessGiven) {
  EXPECT_EQ(Characteristic().force(1.0, 2.0), 0.0);
  EXPECT_EQ(Characteristic().energy(1.0), 0.0);
}

}  // namespace
}  // namespace buckens::base::test
