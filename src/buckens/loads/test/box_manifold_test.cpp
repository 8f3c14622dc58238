// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/box_manifold.h"

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "buckens/spatial/rotation.h"

namespace buckens::loads {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Spots = std::array<ContactSpot, 4>;

ContactShape box(const Vector3d& half) {
  ContactShape out;
  out.kind = ContactShape::Kind::box;
  out.half = half;
  return out;
}

Matrix3d turned(const Vector3d& psi) { return spatial::exp_rotation(psi).toRotationMatrix(); }

/// Force and moment about the second middle of a linear law of stiffness 1 per spot.
Eigen::Matrix<double, 6, 1> wrench(const Spots& spots, const Vector3d& r) {
  Eigen::Matrix<double, 6, 1> out = Eigen::Matrix<double, 6, 1>::Zero();
  for (const ContactSpot& spot : spots) {
    const Vector3d force = spot.share * std::max(0.0, -spot.gap) * spot.normal;
    out.head<3>() += force;
    out.tail<3>() += (spot.place - r).cross(force);
  }
  return out;
}

double energy(const Spots& spots) {
  double sum = 0;
  for (const ContactSpot& spot : spots) {
    sum += 0.5 * spot.share * std::pow(std::max(0.0, -spot.gap), 2);
  }
  return sum;
}

TEST(BoxManifold, FlatFacesOverlapByOneDepth) {
  // A cube on a larger block, turned about the vertical: a quarter of it beyond the block's side.
  const ContactShape block = box({1.0, 1.0, 0.5}), cube = box({0.2, 0.2, 0.2});
  Spots spots;
  for (const double turn : {0.0, 0.3, std::numbers::pi / 4}) {
    find_box_spots(block, cube, {0.5, 0.3, 0.699}, turned({0, 0, turn}), spots);
    for (const ContactSpot& spot : spots) {
      EXPECT_NEAR(spot.gap, -0.001, 1e-15);
      EXPECT_NEAR(spot.share, 1.0, 1e-13);
      EXPECT_NEAR(spot.normal.z(), 1.0, 1e-15);
      EXPECT_NEAR(spot.place.z(), 0.4995, 1e-15);  // halfway between both faces
    }
    const auto F = wrench(spots, {0.5, 0.3, 0.699});
    EXPECT_NEAR(F[2], 0.004, 1e-15);
    EXPECT_LE(F.tail<3>().norm(), 1e-17);
  }
  find_box_spots(block, cube, {1.1, 0.3, 0.699}, Matrix3d::Identity(), spots);
  double share = 0;
  Vector3d middle = Vector3d::Zero();
  for (const ContactSpot& spot : spots) {
    share += 0.25 * spot.share;
    middle += 0.25 * spot.place;
  }
  EXPECT_NEAR(share, 0.25, 1e-14);
  EXPECT_NEAR(middle.x(), 0.95, 1e-14);
}

TEST(BoxManifold, SpotsAreTheIntegralsOverTheArea) {
  // A tilted cube on a block: overlap, its moments and its square against sums over a fine grid.
  const ContactShape block = box({1.0, 1.0, 0.5}), cube = box({0.2, 0.3, 0.2});
  const Matrix3d R = turned({0.02, -0.03, 0.4});
  const Vector3d r(0.1, 0.2, 0.5 + 0.2 - 0.001);
  Spots spots;
  find_box_spots(block, cube, r, R, spots);
  const auto F = wrench(spots, r);
  const double face = (0.4 * 0.6 * 2 + 0.4 * 0.4) / 3;  // mean of the smaller one
  const Eigen::Matrix2d to_face = R.topLeftCorner<2, 2>().inverse();
  double force = 0, x = 0, y = 0, stored = 0;
  constexpr int kCells = 1000;
  const double dA = 0.64 / kCells / kCells;
  for (int i = 0; i < kCells; ++i) {
    for (int j = 0; j < kCells; ++j) {
      // Points of the block's face, as seen in the cube's lower face.
      const Vector3d at(r.x() + 0.8 * ((i + 0.5) / kCells - 0.5),
                        r.y() + 0.8 * ((j + 0.5) / kCells - 0.5), 0.5);
      // Down to the lower face: (R (u, v, -0.2) + r) with the same x and y.
      const Eigen::Vector2d uv = to_face * (at - r + 0.2 * R.col(2)).head<2>();
      if (std::abs(uv.x()) > 0.2 || std::abs(uv.y()) > 0.3) continue;
      const double depth = 0.5 - (R * Vector3d(uv.x(), uv.y(), -0.2) + r).z();
      if (depth <= 0.0) continue;
      force += depth * dA;
      x += depth * at.x() * dA;
      y += depth * at.y() * dA;
      stored += 0.5 * depth * depth * dA;
    }
  }
  // Four spots stand for a face; cells at the edge of the area are 1e-3 of it.
  const double scale = 4.0 / face;
  EXPECT_NEAR(F[2], scale * force, 3e-3 * F[2]);
  EXPECT_NEAR((r.y() * F[2] + F[3]) / F[2], y / force, 1e-3);
  EXPECT_NEAR((r.x() * F[2] - F[4]) / F[2], x / force, 1e-3);
  EXPECT_NEAR(energy(spots), scale * stored, 3e-3 * energy(spots));
}

TEST(BoxManifold, PowerIsTheRateOfItsEnergy) {
  // What turns and sinks within a larger face, on a side or a corner of its own: the forces at the
  // spots do the work that the energy loses, so nothing gains energy by rocking.
  const ContactShape block = box({2.0, 2.0, 0.5}), cube = box({0.2, 0.3, 0.25});
  const Vector3d v(0.3, -0.2, 0.4), w(0.5, 0.7, -0.4);
  for (const double depth : {0.001, 0.01}) {
    const auto r_at = [&](double t) { return Vector3d(Vector3d(0.1, 0.2, 0.75 - depth) + t * v); };
    const auto R_at = [&](double t) {
      return Matrix3d(turned(t * w) * turned({0.03, -0.02, 0.4}));
    };
    const auto energy_at = [&](double t) {
      Spots spots;
      find_box_spots(block, cube, r_at(t), R_at(t), spots);
      return energy(spots);
    };
    Spots spots;
    find_box_spots(block, cube, r_at(0), R_at(0), spots);
    const auto F = wrench(spots, r_at(0));
    const double power = F.head<3>().dot(v) + F.tail<3>().dot(w);
    const double h = 1e-6;
    const double rate = (energy_at(h) - energy_at(-h)) / (2 * h);
    // The area as seen along the normal shrinks with the tilt: second order in the overlap.
    EXPECT_NEAR(power, -rate, 0.2 * depth * std::abs(rate));
  }
}

TEST(BoxManifold, SwappedBoxesTouchAlike) {
  const ContactShape one = box({0.5, 0.4, 0.3}), other = box({0.2, 0.3, 0.25});
  const Matrix3d R = turned({0.3, -0.2, 0.4});
  const Vector3d r(0.2, 0.1, 0.55);
  Spots spots, swapped;
  find_box_spots(one, other, r, R, spots);
  find_box_spots(other, one, -R.transpose() * r, R.transpose(), swapped);
  const auto F = wrench(spots, Vector3d::Zero());
  const auto G = wrench(swapped, -R.transpose() * r);
  ASSERT_GT(F.head<3>().norm(), 1e-4);
  EXPECT_LE((F.head<3>() + R * G.head<3>()).norm(), 1e-14);
  EXPECT_LE((F.tail<3>() + R * G.tail<3>()).norm(), 1e-14);
}

TEST(BoxManifold, CrossedEdgesTouchAtOnePoint) {
  // Two cubes on edge, the lower one's along x, the upper one's along y.
  const ContactShape cube = box({0.5, 0.5, 0.5});
  const Matrix3d lower = turned({std::numbers::pi / 4, 0, 0});
  const Matrix3d upper = turned({0, std::numbers::pi / 4, 0});
  Spots spots;
  const Vector3d r(0.1, -0.2, 2.0 * std::numbers::sqrt2 / 2.0 - 0.002);
  find_box_spots(cube, cube, lower.transpose() * r, lower.transpose() * upper, spots);
  EXPECT_NEAR(spots[0].gap, -0.002, 1e-14);
  EXPECT_LE((lower * spots[0].normal - Vector3d::UnitZ()).norm(), 1e-14);
  EXPECT_LE((lower * spots[0].place - Vector3d(0.1, 0.0, std::numbers::sqrt2 / 2 - 0.001)).norm(),
            1e-14);
  for (std::size_t k = 1; k < 4; ++k) EXPECT_EQ(spots[k].share, 0.0);
}

TEST(BoxManifold, ApartTheyHaveAGap) {
  Spots spots;
  const ContactShape cube = box({0.5, 0.5, 0.5});
  find_box_spots(cube, cube, {0.1, 0.2, 1.3}, Matrix3d::Identity(), spots);
  for (const ContactSpot& spot : spots) {
    EXPECT_NEAR(spot.gap, 0.3, 1e-15);
    EXPECT_EQ(spot.share, 0.0);
  }
}

}  // namespace
}  // namespace buckens::loads
