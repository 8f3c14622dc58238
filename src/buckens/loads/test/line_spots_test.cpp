// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/line_spots.h"

#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "buckens/spatial/rotation.h"

namespace buckens::loads {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using ShapeKind = ContactShape::Kind;
using LineSpots = std::array<ContactSpot, 2>;
using Wrench6 = Eigen::Matrix<double, 6, 1>;

ContactShape solid(ShapeKind kind) {
  ContactShape out;
  out.kind = kind;
  out.radius = kind == ShapeKind::box ? 0.0 : 0.3;
  out.half_length = kind == ShapeKind::box ? 0.0 : 0.5;
  if (kind == ShapeKind::box) out.half = {0.5, 0.4, 0.3};
  return out;
}

ContactShape rod() {
  ContactShape out;
  out.kind = ShapeKind::capsule;
  out.radius = 0.1;
  out.half_length = 0.6;
  out.axis = Vector3d(0.6, 0.0, 0.8);
  return out;
}

Matrix3d rod_turned(const Vector3d& psi) { return spatial::exp_rotation(psi).toRotationMatrix(); }

/// Turns the axis of the rod to a direction.
Matrix3d rod_along(const Vector3d& direction) {
  return Eigen::Quaterniond::FromTwoVectors(rod().axis, direction).toRotationMatrix();
}

double rod_energy(const LineSpots& spots) {
  double sum = 0;
  for (const ContactSpot& spot : spots) {
    if (spot.gap < 0.0) sum += spot.share * 0.5 * spot.gap * spot.gap + spot.held;
  }
  return sum;
}

/// Force on the rod and its moment about its middle.
Wrench6 rod_wrench(const LineSpots& spots, const Vector3d& r) {
  Wrench6 out = Wrench6::Zero();
  for (const ContactSpot& spot : spots) {
    const Vector3d force = spot.share * std::max(0.0, -spot.gap) * spot.normal;
    out.head<3>() += force;
    out.tail<3>() += (spot.place - r).cross(force);
  }
  return out;
}

TEST(LineSpots, ForcesAreTheGradientOfTheirEnergy) {
  // Random placements on faces, edges, corners and rims, by differences of fourth order.
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto random = [&] { return Vector3d(uniform(engine), uniform(engine), uniform(engine)); };
  for (const ShapeKind kind : {ShapeKind::box, ShapeKind::cylinder, ShapeKind::capsule}) {
    const ContactShape first = solid(kind);
    int touching = 0;
    for (int trial = 0; trial < 2000 && touching < 100; ++trial) {
      const Matrix3d R = rod_turned(3.0 * random());
      Vector3d r = random();
      LineSpots spots;
      find_line_spots(first, rod(), r, R, spots);
      // Moved along its normal to an overlap of a hundredth of the radius or so.
      const Vector3d normal = spots[0].gap < spots[1].gap ? spots[0].normal : spots[1].normal;
      const double gap = std::min(spots[0].gap, spots[1].gap);
      if (gap < 0.0) continue;
      r -= (gap + 1e-3 + 5e-3 * std::abs(uniform(engine))) * normal;
      find_line_spots(first, rod(), r, R, spots);
      if (!(std::min(spots[0].gap, spots[1].gap) < 0.0)) continue;
      ++touching;
      const Wrench6 F = rod_wrench(spots, r);
      Wrench6 differences;
      for (int k = 0; k < 6; ++k) {
        const auto energy_at = [&](double x) {
          Vector3d shift = Vector3d::Zero(), turn = Vector3d::Zero();
          (k < 3 ? shift[k] : turn[k - 3]) = x;
          LineSpots moved;
          find_line_spots(first, rod(), r + shift, rod_turned(turn) * R, moved);
          return rod_energy(moved);
        };
        const double h = 2e-6;
        differences[k] =
            -(8.0 * (energy_at(h) - energy_at(-h)) - (energy_at(2 * h) - energy_at(-2 * h))) /
            (12.0 * h);
      }
      // Rounding of energies of 1e-6 over steps of 2e-6, and kinks of second derivatives.
      EXPECT_LE((F - differences).norm(), 1e-6 * F.norm())
          << to_string(kind) << " " << trial << "\n"
          << F.transpose() << "\n"
          << differences.transpose();
    }
    EXPECT_EQ(touching, 100);
  }
}

TEST(LineSpots, OnAFaceBothEndsAreSprings) {
  const ContactShape box = solid(ShapeKind::box);
  ContactShape short_rod = rod();
  short_rod.half_length = 0.2;
  LineSpots spots;
  for (const double tilt : {0.0, 0.002, -0.01, 0.3}) {
    // Lying along x on the upper face, tilted.
    const Vector3d along(std::cos(tilt), 0.0, std::sin(tilt));
    const Vector3d r(0.1, 0.05, 0.3 + 0.1 - 0.001 + 0.2 * std::max(0.0, std::abs(tilt) - 0.01));
    find_line_spots(box, short_rod, r, rod_along(along), spots);
    for (std::size_t k = 0; k < 2; ++k) {
      const double end = k == 0 ? -0.2 : 0.2;
      const double gap = r.z() + end * along.z() - 0.4;
      EXPECT_NEAR(spots[k].gap, gap, 1e-14);
      EXPECT_NEAR(spots[k].share, 1.0, 1e-12);
      if (gap >= 0.0) continue;
      EXPECT_LE((spots[k].normal - Vector3d::UnitZ()).norm(), 1e-12);
      EXPECT_NEAR(spots[k].place.x(), r.x() + end * along.x(), 1e-12);
    }
    EXPECT_NEAR(
        rod_energy(spots),
        0.5 * (std::pow(std::min(0.0, spots[0].gap), 2) + std::pow(std::min(0.0, spots[1].gap), 2)),
        1e-16);
  }
}

TEST(LineSpots, CrossedRodsAreOneSpring) {
  // As two spheres: K, up to δ/R.
  const ContactShape first = solid(ShapeKind::capsule);  // along z
  LineSpots spots;
  const double overlap = 1e-6;
  const Vector3d r(0.4 - overlap, 0.0, 0.1);
  find_line_spots(first, rod(), r, rod_along(Vector3d::UnitY()), spots);
  const Wrench6 F = rod_wrench(spots, r);
  EXPECT_NEAR(F[0], overlap, 1e-5 * overlap);
  EXPECT_LE(F.tail<5>().norm(), 1e-9 * overlap);
  for (const ContactSpot& spot : spots) EXPECT_NEAR(spot.gap, -overlap, 1e-5 * overlap);
  EXPECT_NEAR(rod_energy(spots), 0.5 * overlap * overlap, 1e-5 * overlap * overlap);
}

TEST(LineSpots, ParallelRodsTouchOverTheirCommonLength) {
  // Side by side, shifted along each other: beyond the end of one its round end adds a little.
  const ContactShape first = solid(ShapeKind::capsule);
  LineSpots spots;
  const Vector3d r(0.4 - 1e-4, 0.0, 0.7);
  find_line_spots(first, rod(), r, rod_along(Vector3d::UnitZ()), spots);
  const Wrench6 F = rod_wrench(spots, r);
  // Overlap from 0.1 (the lower end of the second) to 0.5 and over the round end.
  EXPECT_NEAR(F[0], 2 * 35.0 / 48.0 * 1e-4, 1e-5);
  EXPECT_NEAR(spots[0].place.z(), 0.1, 1e-5);  // forces lean a little, by the round end
  EXPECT_NEAR(spots[1].place.z(), 0.5 + std::sqrt(2 * 0.4 * 1e-4), 1e-3);
}

TEST(LineSpots, ApartTheGapIsTheDistance) {
  LineSpots spots;
  const ContactShape box = solid(ShapeKind::box);
  find_line_spots(box, rod(), {0.0, 0.0, 0.7}, rod_along(Vector3d(1, 0.3, 0).normalized()), spots);
  EXPECT_NEAR(std::min(spots[0].gap, spots[1].gap), 0.3, 1e-14);
  find_line_spots(box, rod(), {0.0, 0.0, 1.2}, rod_along(Vector3d::UnitZ()), spots);
  EXPECT_NEAR(std::min(spots[0].gap, spots[1].gap), 0.2, 1e-14);
  // Beside an edge, across it.
  find_line_spots(box, rod(), {0.8, 0.0, 0.7}, rod_along(Vector3d::UnitY()), spots);
  EXPECT_NEAR(std::min(spots[0].gap, spots[1].gap), 0.4, 1e-14);
}

}  // namespace
}  // namespace buckens::loads
