// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/mesh_on_mesh.h"

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "buckens/loads/surface_points.h"
#include "buckens/spatial/rotation.h"

namespace buckens::loads {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using MeshSpotArray = std::array<ContactSpot, kMeshSpots>;
using MeshWrench = Eigen::Matrix<double, 6, 1>;

/// Two triangles per face.
spatial::TriangleList block(const Vector3d& half) {
  spatial::TriangleList out;
  for (int k = 0; k < 8; ++k) {
    out.points.emplace_back((k & 1) != 0 ? half.x() : -half.x(),
                            (k & 2) != 0 ? half.y() : -half.y(),
                            (k & 4) != 0 ? half.z() : -half.z());
  }
  out.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return out;
}

/// A ring of triangles, each of its sections an ellipse: round everywhere.
spatial::TriangleList ring(double radius, double thickness, int around, int across) {
  spatial::TriangleList out;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double u = 2.0 * std::numbers::pi * i / around, v = 2.0 * std::numbers::pi * j / across;
      const double r = radius + thickness * std::cos(v);
      out.points.emplace_back(r * std::cos(u), r * std::sin(u), 0.8 * thickness * std::sin(v));
    }
  }
  const auto at = [&](int i, int j) { return (i % around) * across + j % across; };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      out.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      out.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return out;
}

double mesh_energy(const MeshSpotArray& spots) {
  double sum = 0;
  for (const ContactSpot& spot : spots) {
    if (spot.gap < 0.0) sum += 0.5 * spot.share * spot.gap * spot.gap;
  }
  return sum;
}

/// On the second, about the origin of the first.
MeshWrench mesh_wrench(const MeshSpotArray& spots) {
  MeshWrench out = MeshWrench::Zero();
  for (const ContactSpot& spot : spots) {
    if (!(spot.gap < 0.0)) continue;
    const double size = -spot.share * spot.gap;
    out.head<3>() += size * spot.normal;
    out.tail<3>() += size * (spot.place.cross(spot.normal) + spot.couple);
  }
  return out;
}

Matrix3d mesh_turned(const Vector3d& psi) { return spatial::exp_rotation(psi).toRotationMatrix(); }

/// Minus the derivatives of the energy by displacements of the second and turns about the origin
/// of the first.
MeshWrench slope_of_mesh_energy(const ContactMesh& first, const ContactMesh& second,
                                const Vector3d& r, const Matrix3d& R, double h) {
  MeshWrench out;
  for (int k = 0; k < 6; ++k) {
    const auto energy_at = [&](double x) {
      Vector3d shift = Vector3d::Zero(), turn = Vector3d::Zero();
      (k < 3 ? shift[k] : turn[k - 3]) = x;
      MeshSpotArray moved;
      const Matrix3d Q = mesh_turned(turn);
      find_mesh_spots(first, second, Q * r + shift, Q * R, moved);
      return mesh_energy(moved);
    };
    out[k] = -(energy_at(h) - energy_at(-h)) / (2.0 * h);
  }
  return out;
}

TEST(SurfacePoints, StandForAllOfASurface) {
  const ContactMesh mesh(block({0.5, 0.3, 0.1}), 0.5);
  double area = 0.0;
  Eigen::Vector3d first = Vector3d::Zero();
  for (const SurfacePoints::Point& point : mesh.springs().points()) {
    area += point.area;
    first += point.area * point.at;
    EXPECT_NEAR(mesh.nearest(point.at).distance, 0.0, 1e-15);
  }
  EXPECT_NEAR(area, mesh.area(), 1e-13);
  EXPECT_LE(first.norm(), 1e-13);
  // None is further than the spacing from the next: each stands for less than half its square.
  const double spacing = 0.2 * std::sqrt(mesh.area() / 6.0);
  EXPECT_GE(static_cast<double>(mesh.springs().points().size()), area / (0.5 * spacing * spacing));
}

TEST(MeshOnMesh, AFaceOnAFaceHasTheSpringsOfABox) {
  const ContactMesh table(block({0.5, 0.5, 0.2}), 0.5), cube(block({0.1, 0.1, 0.1}), 0.5);
  MeshSpotArray spots;
  const double overlap = 1e-5;
  const Vector3d r(0.13, -0.2, 0.3 - overlap);
  // However the cube is turned: the springs stand on it.
  for (const double turn : {0.0, 0.4, 1.1}) {
    find_mesh_spots(table, cube, r, mesh_turned({0, 0, turn}), spots);
    const MeshWrench F = mesh_wrench(spots);
    // Places near 0.3 m are rounded by 5e-17 m.
    EXPECT_NEAR(F[2], 4.0 * overlap, 1e-15) << turn;
    EXPECT_LE(F.head<2>().norm(), 1e-12 * F[2]) << turn;
    EXPECT_NEAR(F[3], r.y() * F[2], 1e-11 * F[2]) << turn;
    EXPECT_NEAR(F[4], -r.x() * F[2], 1e-11 * F[2]) << turn;
    EXPECT_NEAR(mesh_energy(spots), 0.5 * 4.0 * overlap * overlap, 1e-15 * overlap);
    for (const ContactSpot& spot : spots) {
      if (!(spot.gap < 0.0)) continue;
      EXPECT_NEAR(spot.gap, -overlap, 1e-14);
      EXPECT_NEAR(spot.place.z(), 0.2 - 0.5 * overlap, 1e-14);
      // Spread as the face: a²/12 along each of both directions, but for the points' distance.
      EXPECT_NEAR((spot.place - r).head<2>().norm(), 0.2 * std::sqrt(2.0 / 12.0), 2e-3);
    }
  }
  // The other way round nothing changes but the side.
  find_mesh_spots(cube, table, -r, Matrix3d::Identity(), spots);
  EXPECT_NEAR(mesh_wrench(spots)[2], -4.0 * overlap, 1e-15);
}

TEST(MeshOnMesh, ForcesAreTheDerivativeOfTheEnergyAnywhere) {
  const ContactMesh cube(block({0.2, 0.2, 0.2}), 0.5), brick(block({0.25, 0.2, 0.15}), 0.5),
      small(block({0.05, 0.06, 0.04}), 0.5), torus(ring(0.2, 0.07, 24, 12), 0.8);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const std::array<std::array<const ContactMesh*, 2>, 5> pairs = {
      {{&cube, &brick}, {&cube, &small}, {&small, &cube}, {&torus, &torus}, {&cube, &torus}}};
  int tried = 0;
  for (int k = 0; k < 60; ++k) {
    const auto& [first, second] = pairs[static_cast<std::size_t>(k) % pairs.size()];
    const Matrix3d R = mesh_turned(2.0 * Vector3d(any(random), any(random), any(random)));
    // Towards the first until they overlap by a few hundredths of their size.
    const Vector3d way = Vector3d(any(random), any(random), any(random)).normalized();
    MeshSpotArray spots;
    Vector3d r = 0.8 * way;
    for (int n = 0; n < 160 && mesh_energy(spots) < 1e-7; ++n) {
      r -= 0.005 * way;
      find_mesh_spots(*first, *second, r, R, spots);
    }
    if (mesh_energy(spots) < 1e-7) continue;
    const MeshWrench F = mesh_wrench(spots);
    const MeshWrench slope = slope_of_mesh_energy(*first, *second, r, R, 1e-7);
    ++tried;
    // Differences over 2e-7 m of energies of 1e-7 and more, and points that the difference brings
    // from one nearest face to the next.
    EXPECT_LE((F - slope).norm(), 1e-4 * F.norm()) << k << "\n"
                                                   << F.transpose() << "\n"
                                                   << slope.transpose();
  }
  EXPECT_GT(tried, 45);
}

TEST(MeshOnMesh, ApartTheyKnowHowFar) {
  const ContactMesh cube(block({0.2, 0.2, 0.2}), 0.5), brick(block({0.25, 0.2, 0.15}), 0.5);
  MeshSpotArray spots;
  find_mesh_spots(cube, brick, {0.1, 0.1, 0.45}, Matrix3d::Identity(), spots);
  EXPECT_NEAR(spots[0].gap, 0.1, 1e-14);
  EXPECT_LE((spots[0].normal - Vector3d::UnitZ()).norm(), 1e-14);
  // A corner towards the face: the nearest point is beside it.
  const Matrix3d R =
      Eigen::Quaterniond::FromTwoVectors(Vector3d(-0.25, -0.2, -0.15), -Vector3d::UnitZ())
          .toRotationMatrix();
  const double reach = Vector3d(0.25, 0.2, 0.15).norm();
  find_mesh_spots(cube, brick, {0, 0, 0.25 + reach}, R, spots);
  EXPECT_NEAR(spots[0].gap, 0.05, 2e-3);
}

}  // namespace
}  // namespace buckens::loads
