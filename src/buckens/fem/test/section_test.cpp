// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/line/section.h"

#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/base/errors.h"

namespace buckens::fem {
namespace {

/// ∫ f dA over the points of a box from −w…w by −h…h where `inside` holds: midpoint rule.
template <class Inside>
Section sum_area(double w, double h, Inside inside) {
  constexpr int kCells = 1200;
  Section s;
  const double cell = 4 * w * h / kCells / kCells;
  for (int i = 0; i < kCells; ++i) {
    for (int j = 0; j < kCells; ++j) {
      const double y = w * (2 * (i + 0.5) / kCells - 1);
      const double z = h * (2 * (j + 0.5) / kCells - 1);
      if (!inside(y, z)) continue;
      s.A += cell;
      s.Iy += cell * z * z;
      s.Iz += cell * y * y;
    }
  }
  return s;
}

void expect_same_moments(const Section& s, const Section& expected, double tolerance) {
  EXPECT_NEAR(s.A, expected.A, tolerance * s.A);
  EXPECT_NEAR(s.Iy, expected.Iy, tolerance * s.Iy);
  EXPECT_NEAR(s.Iz, expected.Iz, tolerance * s.Iz);
}

// The midpoint rule is exact to 1e-6 where cells follow the rim, to 1e-3 on curved rims.
TEST(Section, MomentsEqualSumsOverTheArea) {
  expect_same_moments(Section::rectangle(0.03, 0.05),
                      sum_area(0.015, 0.025, [](double, double) { return true; }), 1e-5);
  expect_same_moments(
      Section::box(0.06, 0.04, 0.005),
      sum_area(0.03, 0.02,
               [](double y, double z) { return std::abs(y) > 0.025 || std::abs(z) > 0.015; }),
      1e-5);
  expect_same_moments(
      Section::circle(0.1),
      sum_area(0.05, 0.05, [](double y, double z) { return std::hypot(y, z) < 0.05; }), 1e-3);
  expect_same_moments(Section::tube(0.1, 0.07),
                      sum_area(0.05, 0.05,
                               [](double y, double z) {
                                 const double r = std::hypot(y, z);
                                 return r < 0.05 && r > 0.035;
                               }),
                      1e-3);
}

TEST(Section, TorsionOfKnownShapes) {
  EXPECT_NEAR(Section::circle(0.1).J, M_PI * 1e-4 / 32, 1e-18);
  // Exact series: J = 0.140577 a⁴ for a square, 0.228682 a⁴ for 2:1; the formula is within 0.5 %.
  EXPECT_NEAR(Section::rectangle(1, 1).J, 0.140577, 0.005 * 0.14);
  EXPECT_NEAR(Section::rectangle(1, 2).J, 2 * 0.228682, 0.005 * 0.46);
  EXPECT_EQ(Section::rectangle(1, 2).J, Section::rectangle(2, 1).J);
  // τ_max = M / (0.208 a³) for a square, M / (0.246 · 2 a³) for 2:1.
  EXPECT_NEAR(Section::rectangle(1, 1).torsion_modulus, 0.208, 0.005 * 0.208);
  EXPECT_NEAR(Section::rectangle(1, 2).torsion_modulus, 0.492, 0.005 * 0.492);
  // A thin box against a thin tube of equal middle line: both obey Bredt's formulas.
  const Section box = Section::box(0.101, 0.101, 0.001);
  EXPECT_NEAR(box.J, std::pow(0.1, 3) * 0.001, 1e-12);
  EXPECT_NEAR(box.torsion_modulus, 2 * 0.01 * 0.001, 1e-12);
}

TEST(Section, ShearFactorsOfKnownShapes) {
  EXPECT_NEAR(Section::circle(0.1).shear_y, 6.0 / 7, 1e-15);
  EXPECT_NEAR(Section::tube(0.1, 0.0999).shear_z, 0.5, 1e-3);
  EXPECT_NEAR(Section::rectangle(1, 3).shear_z, 5.0 / 6, 1e-15);
  EXPECT_NEAR(Section::circle(0.1).shear_peak_y, 4.0 / 3, 1e-15);
  EXPECT_NEAR(Section::tube(0.1, 0.0999).shear_peak_y, 2.0, 1e-3);
  // Cowper's 20 (1 + ν) / (48 + 39 ν) of a thin square box.
  EXPECT_NEAR(Section::box(0.1, 0.1, 0.001).shear_y, 20.0 / 48, 1e-14);
  EXPECT_NEAR(Section::box(0.1, 0.1, 0.001).shear_y, Section::box(0.1, 0.1, 0.001).shear_z, 1e-15);
  // Nearly solid box: the peak of a rectangle.
  EXPECT_NEAR(Section::box(0.1, 0.2, 0.04999).shear_peak_z, 1.5, 0.01);
}

TEST(Section, RefusesImpossibleMeasures) {
  EXPECT_THROW(Section::circle(0), ModelError);
  EXPECT_THROW(Section::tube(0.1, 0.1), ModelError);
  EXPECT_THROW(Section::box(0.1, 0.1, 0.05), ModelError);
  EXPECT_THROW(Section::general(1, 1, -1, 1), ModelError);
  EXPECT_THROW(Section::area(std::nan("")), ModelError);
}

/// A, ∫ y dA, ∫ z dA, ∫ z² dA, ∫ y² dA inside closed polygons by Green's theorem; holes count
/// negatively because they turn the other way.
Eigen::Matrix<double, 5, 1> moments_of(const std::vector<SectionLoop>& outline) {
  Eigen::Matrix<double, 5, 1> sum = Eigen::Matrix<double, 5, 1>::Zero();
  for (const SectionLoop& loop : outline) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Eigen::Vector2d a = loop[k], b = loop[(k + 1) % loop.size()];
      const double cross = a.x() * b.y() - b.x() * a.y();
      sum[0] += cross / 2;
      sum[1] += cross * (a.x() + b.x()) / 6;
      sum[2] += cross * (a.y() + b.y()) / 6;
      sum[3] += cross * (a.y() * a.y() + a.y() * b.y() + b.y() * b.y()) / 12;
      sum[4] += cross * (a.x() * a.x() + a.x() * b.x() + b.x() * b.x()) / 12;
    }
  }
  return sum;
}

TEST(Section, OutlineHasTheMomentsOfTheSection) {
  // Polygons of 24 corners have 1.1 % less area than circles and 2.3 % smaller second moments.
  const std::vector<std::pair<Section, double>> all = {{Section::rectangle(0.03, 0.05), 1e-14},
                                                       {Section::box(0.04, 0.06, 0.003), 1e-14},
                                                       {Section::circle(0.02), 0.024},
                                                       {Section::tube(0.04, 0.03), 0.024}};
  for (const auto& [section, tolerance] : all) {
    const auto moments = moments_of(section.outline);
    EXPECT_NEAR(moments[0], section.A, tolerance * section.A);
    EXPECT_NEAR(moments[1], 0, 1e-15 * section.A);
    EXPECT_NEAR(moments[2], 0, 1e-15 * section.A);
    EXPECT_NEAR(moments[3], section.Iy, tolerance * section.Iy);
    EXPECT_NEAR(moments[4], section.Iz, tolerance * section.Iz);
  }
  // Constants alone: a rectangle with the same radii of gyration.
  const Section general = Section::general(3e-4, 4e-8, 1e-8, 2e-8);
  const auto moments = moments_of(general.outline);
  EXPECT_NEAR(moments[3] / moments[0], general.Iy / general.A, 1e-14 * general.Iy / general.A);
  EXPECT_NEAR(moments[4] / moments[0], general.Iz / general.A, 1e-14 * general.Iz / general.A);
}

TEST(Section, HullGoesAroundPointsFromYToZ) {
  const SectionLoop hull =
      convex_hull({{0, 0}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}, {0.5, 1}, {1, 1}, {-1, 0}});
  EXPECT_EQ(hull, (SectionLoop{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}));
  EXPECT_NEAR(moments_of({hull})[0], 4.0, 1e-15);
  EXPECT_LT(convex_hull({{0, 0}, {1, 1}, {2, 2}}).size(), 3U);
  EXPECT_LT(convex_hull({{1, 1}, {1, 1}}).size(), 3U);
}

}  // namespace
}  // namespace buckens::fem
