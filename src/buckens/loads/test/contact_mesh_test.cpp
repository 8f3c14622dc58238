// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/contact_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/loads/contact_pair.h"

namespace buckens::loads {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

constexpr double kSmooth = 0.52;

/// An octahedron whose triangles are divided into four again and again, moved out to radius one.
spatial::TriangleList globe(int levels) {
  spatial::TriangleList out;
  for (int axis = 0; axis < 3; ++axis) {
    out.points.push_back(Vector3d::Unit(axis));
    out.points.push_back(-Vector3d::Unit(axis));
  }
  for (const std::array<int, 3>& t : {std::array{0, 2, 4},
                                      {2, 1, 4},
                                      {1, 3, 4},
                                      {3, 0, 4},
                                      {2, 0, 5},
                                      {1, 2, 5},
                                      {3, 1, 5},
                                      {0, 3, 5}}) {
    out.triangles.push_back(t);
  }
  for (int k = 0; k < levels; ++k) {
    std::map<std::pair<int, int>, int> middles;
    std::vector<std::array<int, 3>> finer;
    const auto middle = [&](int a, int b) {
      const auto [at, is_new] =
          middles.emplace(std::minmax(a, b), static_cast<int>(out.points.size()));
      if (is_new) {
        out.points.push_back(
            (out.points[static_cast<std::size_t>(a)] + out.points[static_cast<std::size_t>(b)])
                .normalized());
      }
      return at->second;
    };
    for (const auto& [a, b, c] : out.triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    out.triangles = std::move(finer);
  }
  return out;
}

/// A cube from −1 to 1 of twelve triangles with corners of their own, as STL files have them.
spatial::TriangleList cube() {
  spatial::TriangleList out;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const Vector3d n = side * Vector3d::Unit(axis), u = Vector3d::Unit((axis + 1) % 3),
                     v = side * Vector3d::Unit((axis + 2) % 3);
      const std::array<Vector3d, 4> c = {n - u - v, n + u - v, n + u + v, n - u + v};
      for (const auto& t : {std::array{0, 1, 2}, {0, 2, 3}}) {
        const int first = static_cast<int>(out.points.size());
        for (const int k : t) out.points.push_back(c[static_cast<std::size_t>(k)]);
        out.triangles.push_back({first, first + 1, first + 2});
      }
    }
  }
  return out;
}

TEST(ContactMesh, FindsWhatComparingAllFacetsFinds) {
  const ContactMesh mesh(globe(3), kSmooth);
  EXPECT_EQ(mesh.num_patches(), 1);
  EXPECT_TRUE(mesh.is_closed());
  std::mt19937 engine(11);
  std::normal_distribution<double> place;
  for (int k = 0; k < 300; ++k) {
    const Vector3d point(place(engine), place(engine), place(engine));
    const ContactMesh::Nearest found = mesh.nearest(point);
    // The surface is within 1e-4 of the unit sphere: distances to it are known.
    EXPECT_NEAR(found.distance, point.norm() - 1.0, 1e-4) << point.transpose();
    if (point.norm() > 0.2) {
      EXPECT_GT(found.normal.dot(point.normalized()), 0.999);
    }
  }
}

TEST(ContactMesh, BulgesTowardsTheSphereWithThirdOrderOrBetter) {
  std::array<double, 3> worst{};
  for (int levels = 2; levels <= 4; ++levels) {
    const ContactMesh mesh(globe(levels), kSmooth);
    std::mt19937 engine(5);
    std::normal_distribution<double> place;
    for (int k = 0; k < 2000; ++k) {
      const Vector3d point =
          1.3 * Vector3d(place(engine), place(engine), place(engine)).normalized();
      auto& own = worst[static_cast<std::size_t>(levels - 2)];
      own = std::max(own, std::abs(mesh.nearest(point).distance - 0.3));
    }
  }
  // Flat facets would gain a factor of 4 with each division.
  EXPECT_GT(worst[0] / worst[1], 8.0);
  EXPECT_GT(worst[1] / worst[2], 8.0);
  EXPECT_LT(worst[2], 1e-5);
}

TEST(ContactMesh, HasANormalThatIsTheGradientOfTheDistance) {
  const ContactMesh smooth(globe(2), kSmooth), sharp(cube(), kSmooth);
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> place(-1.6, 1.6);
  constexpr double kStep = 1e-6;
  for (const ContactMesh* mesh : {&smooth, &sharp}) {
    int kinks = 0;
    for (int k = 0; k < 300; ++k) {
      const Vector3d point(place(engine), place(engine), place(engine));
      const ContactMesh::Nearest found = mesh->nearest(point);
      Vector3d gradient;
      for (int axis = 0; axis < 3; ++axis) {
        const Vector3d e = kStep * Vector3d::Unit(axis);
        gradient[axis] =
            (mesh->nearest(point + e).distance - mesh->nearest(point - e).distance) / (2 * kStep);
      }
      kinks += (gradient - found.normal).norm() > 1e-6 ? 1 : 0;
    }
    // Only where a point is as near to one facet as to another.
    EXPECT_LE(kinks, 2);
  }
}

TEST(ContactMesh, TellsInsideFromOutsideAtFacesEdgesAndCorners) {
  const ContactMesh mesh(cube(), kSmooth);
  EXPECT_EQ(mesh.num_patches(), 6);
  EXPECT_EQ(mesh.num_colours(), 3);  // opposite faces share theirs
  EXPECT_DOUBLE_EQ(mesh.area(), 24.0);
  EXPECT_NEAR(mesh.nearest({0.3, 0.2, 1.5}).distance, 0.5, 1e-15);
  EXPECT_NEAR(mesh.nearest({0.3, 0.2, 0.9}).distance, -0.1, 1e-15);
  EXPECT_NEAR(mesh.nearest({1.3, 0.1, 1.4}).distance, 0.5, 1e-15);
  EXPECT_NEAR(mesh.nearest({1.2, 1.1, 1.2}).distance, 0.3, 1e-15);
  EXPECT_LT((mesh.nearest({1.3, 0.1, 1.4}).normal - Vector3d(0.6, 0, 0.8)).norm(), 1e-14);
}

/// Force of a linear contact law on a sphere by all spots.
Vector3d push(const ContactPair& pair, const Vector3d& centre, double& energy) {
  ContactPair::Spots spots;
  pair.find(centre, Eigen::Matrix3d::Identity(), spots);
  Vector3d sum = Vector3d::Zero();
  energy = 0.0;
  for (int k = 0; k < pair.num_spots(); ++k) {
    const ContactSpot& spot = spots[static_cast<std::size_t>(k)];
    const double overlap = std::max(0.0, -spot.gap);
    sum += overlap * spot.normal;
    energy += 0.5 * overlap * overlap;
  }
  return sum;
}

TEST(MeshContact, OfASphereHasAPotentialAlsoOverEdgesAndCorners) {
  ContactShape mesh, sphere;
  mesh.kind = ContactShape::Kind::mesh;
  mesh.mesh = std::make_shared<const ContactMesh>(cube(), kSmooth);
  sphere.radius = 0.3;
  const ContactPair pair(mesh, sphere);
  // Around an edge and a corner on a way that is 0.25 from the surface: the force's work is what
  // the energy loses, so none of the places is counted twice or left out.
  double energy = 0.0, next = 0.0, work = 0.0;
  Vector3d at(0.5, 0.4, 1.25);
  push(pair, at, energy);
  const double first = energy;
  constexpr int kSteps = 20000;
  for (int k = 1; k <= kSteps; ++k) {
    const double s = static_cast<double>(k) / kSteps;
    const Vector3d to = at + (Vector3d(0.5 + 0.72 * s, 0.4 + 0.75 * s * s, 1.25 - 0.1 * s) - at);
    const Vector3d force = push(pair, 0.5 * (at + to), next);
    work += force.dot(to - at);
    push(pair, to, next);
    ASSERT_LT(std::abs(next - energy), 1e-5) << to.transpose();
    energy = next;
    at = to;
  }
  EXPECT_NEAR(work, first - energy, 1e-8);
}

TEST(MeshContact, OfACubeOnAPlaneIsThatOfABox) {
  ContactShape plane, mesh;
  plane.kind = ContactShape::Kind::plane;
  mesh.kind = ContactShape::Kind::mesh;
  mesh.mesh = std::make_shared<const ContactMesh>(cube(), kSmooth);
  const ContactPair pair(plane, mesh);
  ContactPair::Spots spots;
  // Tilted by a little, so that one side leans over the plane and the other one away from it.
  const double tilt = std::atan(0.05);
  const Eigen::Matrix3d R = Eigen::AngleAxisd(tilt, Vector3d::UnitY()).toRotationMatrix();
  const Vector3d r = -0.1 * Vector3d::UnitZ() + R * Vector3d::UnitZ();
  pair.find(r, R, spots);
  double force = 0.0, moment = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    force -= spots[k].share * spots[k].gap;
    moment -= spots[k].share * spots[k].gap * spots[k].place.x();
  }
  // Volume below the plane and its moment, relative to the face of 4, four quarters: of the
  // section, a quadrilateral, times the width of 2.
  const double c = std::cos(tilt), s = std::sin(tilt);
  const std::array<Eigen::Vector2d, 4> section = {Eigen::Vector2d(-c, s - 0.1),
                                                  {c, -s - 0.1},
                                                  {c + (0.1 + s) * s / c, 0},
                                                  {-c + (0.1 - s) * s / c, 0}};
  double area = 0.0, first = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    const Eigen::Vector2d &a = section[k], &b = section[(k + 1) % 4];
    const double cross = a.x() * b.y() - a.y() * b.x();
    area += 0.5 * cross;
    first += cross * (a.x() + b.x()) / 6.0;
  }
  EXPECT_NEAR(force, 2.0 * area, 1e-12);
  EXPECT_NEAR(moment, 2.0 * first, 1e-12);
  // Level, the overlap is the same everywhere, and the spots have all of the energy.
  pair.find(0.9 * Vector3d::UnitZ(), Eigen::Matrix3d::Identity(), spots);
  EXPECT_NEAR(spots[0].held, 0.0, 1e-15);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(spots[k].gap, -0.1, 1e-15);
    EXPECT_NEAR(spots[k].place.head<2>().cwiseAbs().minCoeff(), 1.0 / std::sqrt(3.0), 1e-14);
  }
}

TEST(MeshContact, OfAGlobeOnAPlaneKeepsTheEnergyOfItsVolume) {
  ContactShape plane, mesh;
  plane.kind = ContactShape::Kind::plane;
  mesh.kind = ContactShape::Kind::mesh;
  mesh.mesh = std::make_shared<const ContactMesh>(globe(4), kSmooth);
  const ContactPair pair(plane, mesh);
  ContactPair::Spots spots;
  double force = 0.0;
  const auto energy = [&](double height) {
    pair.find(height * Vector3d::UnitZ(), Eigen::Matrix3d::Identity(), spots);
    double sum = spots[0].held;
    force = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      sum += 0.5 * spots[k].share * spots[k].gap * spots[k].gap;
      force -= spots[k].share * spots[k].gap;
    }
    return sum;
  };
  const double slope = (energy(0.9 + 1e-5) - energy(0.9 - 1e-5)) / 2e-5;
  energy(0.9);
  EXPECT_NEAR(force, -slope, 1e-7);
}

TEST(ContactMesh, RefusesSurfacesThatLookToBothSides) {
  const auto message = [](const spatial::TriangleList& list) -> std::string {
    try {
      const ContactMesh mesh(list, kSmooth);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  spatial::TriangleList turned = cube();
  std::swap(turned.triangles[0][0], turned.triangles[0][1]);
  EXPECT_THAT(message(turned), HasSubstr("look to different sides"));
  spatial::TriangleList inwards = cube();
  for (auto& t : inwards.triangles) std::swap(t[0], t[1]);
  EXPECT_THAT(message(inwards), HasSubstr("look inwards"));
  spatial::TriangleList flat;
  flat.points = {Vector3d::Zero(), Vector3d::UnitX(), 2 * Vector3d::UnitX()};
  flat.triangles = {{0, 1, 2}};
  EXPECT_THAT(message(flat), HasSubstr("none of its triangles has an area"));
}

}  // namespace
}  // namespace buckens::loads
