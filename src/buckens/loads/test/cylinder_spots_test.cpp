// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/cylinder_spots.h"

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "buckens/spatial/rotation.h"

namespace buckens::loads {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using ShapeKind = ContactShape::Kind;
using DrumSpots = std::array<ContactSpot, kCylinderSpots>;
using DrumWrench = Eigen::Matrix<double, 6, 1>;
constexpr double kPi = std::numbers::pi;

ContactShape table() {
  ContactShape out;
  out.kind = ShapeKind::box;
  out.half = {1.0, 0.8, 0.5};
  return out;
}

ContactShape drum(double radius = 0.2, double half_length = 0.3) {
  ContactShape out;
  out.kind = ShapeKind::cylinder;
  out.radius = radius;
  out.half_length = half_length;
  return out;
}

Matrix3d drum_turned(const Vector3d& psi) { return spatial::exp_rotation(psi).toRotationMatrix(); }

double drum_energy(const DrumSpots& spots) {
  double sum = 0;
  for (const ContactSpot& spot : spots) {
    if (spot.gap < 0.0) sum += 0.5 * spot.share * spot.gap * spot.gap + spot.held;
  }
  return sum;
}

DrumWrench drum_wrench(const DrumSpots& spots, const Vector3d& r) {
  DrumWrench out = DrumWrench::Zero();
  for (const ContactSpot& spot : spots) {
    const Vector3d force = spot.share * std::max(0.0, -spot.gap) * spot.normal;
    out.head<3>() += force;
    out.tail<3>() += (spot.place - r).cross(force);
  }
  return out;
}

/// Minus the derivatives of the energy by displacements and turns of the second.
DrumWrench slope_of_energy(const ContactShape& first, const ContactShape& second, const Vector3d& r,
                           const Matrix3d& R, double h) {
  DrumWrench out;
  for (int k = 0; k < 6; ++k) {
    const auto energy_at = [&](double x) {
      Vector3d shift = Vector3d::Zero(), turn = Vector3d::Zero();
      (k < 3 ? shift[k] : turn[k - 3]) = x;
      DrumSpots moved;
      find_cylinder_spots(first, second, r + shift, drum_turned(turn) * R, moved);
      return drum_energy(moved);
    };
    out[k] = -(8.0 * (energy_at(h) - energy_at(-h)) - (energy_at(2 * h) - energy_at(-2 * h))) /
             (12.0 * h);
  }
  return out;
}

TEST(CylinderSpots, ACrateOnARoundTableStaysInItsMiddle) {
  // Four wedges at the sides of the crate beside the face: none of them may be left out.
  ContactShape crate = table();
  crate.half = {0.2, 0.15, 0.1};
  const ContactShape on = drum(0.5, 0.3);
  const double overlap = 1e-3;
  const Vector3d r(0.0, 0.0, -(0.1 + 0.3) + overlap);
  DrumSpots spots;
  find_cylinder_spots(crate, on, r, Matrix3d::Identity(), spots);
  const DrumWrench F = drum_wrench(spots, r);
  EXPECT_LT(F[2], 0.0);
  EXPECT_LE(F.head<2>().norm(), 1e-12 * -F[2]);
  EXPECT_NEAR((F - slope_of_energy(crate, on, r, Matrix3d::Identity(), 1e-6)).norm(), 0,
              1e-6 * F.norm());
}

TEST(CylinderSpots, CornersMayLieOnTheRim) {
  // Sides of 3 and 4, and a radius of 5, but for rounding.
  ContactShape crate = table();
  crate.half = {0.3, 0.4, 0.1};
  for (const double turn : {0.0, 0.3, 1.0, 2.2}) {
    const ContactShape on = drum(0.5, 0.3);
    const double overlap = 1e-3;
    const Vector3d r(0.0, 0.0, -(0.1 + 0.3) + overlap);
    DrumSpots spots;
    find_cylinder_spots(crate, on, r, drum_turned({0, 0, turn}), spots);
    const double face = 4.0 / 3.0 * (0.3 * 0.4 + 0.4 * 0.1 + 0.1 * 0.3);
    // A frustum below the face: nearer to the sides, the depth counts from there.
    const double volume =
        0.6 * 0.8 * overlap - (0.6 + 0.8) * std::pow(overlap, 2) + 4.0 / 3.0 * std::pow(overlap, 3);
    EXPECT_NEAR(drum_wrench(spots, r)[2], -4.0 / face * volume, 1e-13) << turn;
  }
}

TEST(CylinderSpots, AnEndThatLiesOnAFaceHasFourSprings) {
  DrumSpots spots;
  const ContactShape on = drum();
  const Vector3d r(0.2, -0.1, 0.5 + 0.3 - 1e-4);
  find_cylinder_spots(table(), on, r, drum_turned({0, 0, 0.7}), spots);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(spots[k].gap, -1e-4, 1e-15);
    EXPECT_NEAR(spots[k].share, 1.0, 1e-11);
    EXPECT_LE((spots[k].normal - Vector3d::UnitZ()).norm(), 1e-15);
    // c ± M e with M = radius/2 for a disc, on its diagonals.
    EXPECT_NEAR((spots[k].place - Vector3d(0.2, -0.1, 0.49995)).norm(), 0.1 * std::sqrt(2.0), 1e-9);
  }
  const DrumWrench F = drum_wrench(spots, r);
  EXPECT_NEAR(F[2], 4e-4, 1e-15);
  EXPECT_LE(F.tail<3>().norm(), 1e-16);
  // Tilted a little: springs over the disc resist with 4 K/πR² · πR⁴/4.
  const double tilt = 1e-5;
  find_cylinder_spots(table(), on, r, drum_turned({tilt, 0, 0}), spots);
  const double lever = r.z() - 0.5;
  // But for the moment of the weight about the middle of the drum, 4 K δ times its lever, and for
  // the rim that lifts off on one side where tilt R comes to 2 % of δ.
  EXPECT_NEAR(drum_wrench(spots, r)[3] / tilt, -0.2 * 0.2, 0.02 * 0.04 + 4e-4 * lever);
}

TEST(CylinderSpots, OnItsSideItSinksAsItsSegmentSays) {
  // Force 4 K/πR² · L · area of the circular segment, independent of how it is turned.
  const double overlap = 1e-3, radius = 0.2;
  const double half_angle = std::acos(1.0 - overlap / radius);
  const double segment =
      radius * radius * (half_angle - std::sin(half_angle) * std::cos(half_angle));
  DrumSpots spots;
  for (const double roll : {0.0, 0.4, 2.0}) {
    const Matrix3d R =
        drum_turned({0, 0, 0.3}) * drum_turned({kPi / 2, 0, 0}) * drum_turned({0, 0, roll});
    const Vector3d r(0.1, 0.1, 0.5 + radius - overlap);
    find_cylinder_spots(table(), drum(), r, R, spots);
    const DrumWrench F = drum_wrench(spots, r);
    EXPECT_NEAR(F[2], 4.0 / (kPi * radius * radius) * 0.6 * segment, 1e-11 * F[2]);
    EXPECT_LE(F.head<2>().norm() + F.tail<3>().norm(), 1e-11 * F[2]);
  }
  // The same on a flat side that is as narrow as half of it.
  ContactShape plank = table();
  plank.half.y() = 0.15;
  find_cylinder_spots(plank, drum(), {0.1, 0.0, 0.5 + radius - overlap},
                      drum_turned({kPi / 2, 0, 0}), spots);
  const double narrow = 4.0 / (kPi * 0.04) * 0.3 * segment;
  EXPECT_NEAR(drum_wrench(spots, {0.1, 0, 0.7})[2], narrow,
              1e-2 * narrow);  // sides are nearer at its edges
}

TEST(CylinderSpots, StackedDrumsTouchWithTheirEnds) {
  DrumSpots spots;
  const Vector3d r(0.1, 0.0, 0.6 - 1e-4);
  find_cylinder_spots(drum(), drum(), r, drum_turned({0, 0, 0.4}), spots);
  // The lens that two circles have in common.
  const double half_angle = std::acos(0.05 / 0.2);
  const double lens = 2.0 * 0.04 * (half_angle - std::sin(half_angle) * std::cos(half_angle));
  const DrumWrench F = drum_wrench(spots, r);
  // Near the rim, within the overlap of it, the side is nearer.
  EXPECT_NEAR(F[2], 4.0 / (kPi * 0.04) * lens * 1e-4, 2e-3 * F[2]);
  EXPECT_NEAR(spots[0].gap, -1e-4, 1e-6);
}

TEST(CylinderSpots, DrumsSideBySideTouchOverTheirCommonLength) {
  DrumSpots spots;
  const double overlap = 1e-3;
  const Vector3d r(0.4 - overlap, 0.0, 0.2);
  find_cylinder_spots(drum(), drum(), r, Matrix3d::Identity(), spots);
  const double half_angle = std::acos(1.0 - 0.5 * overlap / 0.2);
  const double lens = 2.0 * 0.04 * (half_angle - std::sin(half_angle) * std::cos(half_angle));
  const DrumWrench F = drum_wrench(spots, r);
  // Common length 0.4; normals lean by some 0.05 at the borders of the lens, ends are nearer within
  // the overlap.
  EXPECT_NEAR(F[0], 4.0 / (kPi * 0.04) * 0.4 * lens, 3e-3 * F[0]);
  // Both forces stand for a line from z = −0.1 to 0.3.
  EXPECT_NEAR(F[4], -0.1 * F[0], 5e-3 * F[0]);
  EXPECT_NEAR(spots[5].place.z() - spots[4].place.z(), 0.4 / std::sqrt(3.0), 2e-3);
}

/// Random placements with small overlaps on faces, sides, edges and rims. Forces and energy have
/// sums by Gauss over places where an edge begins or ends to reach in: no rounding, but small.
/// @param typical mean of the relative errors
void expect_gradient(const ContactShape& first, const ContactShape& second, double tolerance,
                     double typical) {
  std::mt19937 engine(11);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto random = [&] { return Vector3d(uniform(engine), uniform(engine), uniform(engine)); };
  int touching = 0;
  double sum = 0.0;
  for (int trial = 0; trial < 4000 && touching < 60; ++trial) {
    const Matrix3d R = drum_turned(3.0 * random());
    Vector3d r = 1.5 * random();
    DrumSpots spots;
    find_cylinder_spots(first, second, r, R, spots);
    if (!(spots[0].gap > 0.0)) continue;
    r -= (spots[0].gap + 2e-3 + 4e-3 * std::abs(uniform(engine))) * spots[0].normal;
    find_cylinder_spots(first, second, r, R, spots);
    const DrumWrench F = drum_wrench(spots, r);
    if (!(F.norm() > 0.0)) continue;
    ++touching;
    const DrumWrench wanted = slope_of_energy(first, second, r, R, 2e-6);
    const double error = (F - wanted).norm() / F.norm();
    sum += error;
    EXPECT_LE(error, tolerance) << trial << "\n" << F.transpose() << "\n" << wanted.transpose();
  }
  EXPECT_EQ(touching, 60);
  EXPECT_LE(sum / touching, typical);
}

TEST(CylinderSpots, ForcesAreTheGradientOfTheirEnergyOnABox) {
  expect_gradient(table(), drum(), 1e-2, 3e-4);
}

TEST(CylinderSpots, ForcesAreTheGradientOfTheirEnergyOnACylinder) {
  expect_gradient(drum(0.3, 0.25), drum(), 2e-2, 1e-3);
}

}  // namespace
}  // namespace buckens::loads
