// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <map>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "buckens/fem/element/quadrature.h"
#include "buckens/fem/solid/shape.h"

namespace buckens::fem {
namespace {

using Eigen::Vector3d;

class SolidShapes : public testing::TestWithParam<SolidKind> {};

TEST_P(SolidShapes, AreOneAtTheirNodeAndZeroAtOthers) {
  const SolidTopology& element = solid_topology(GetParam());
  for (int node = 0; node < element.num_nodes; ++node) {
    const SolidShape shape = solid_shape(GetParam(), element.natural.col(node));
    for (int other = 0; other < element.num_nodes; ++other) {
      EXPECT_NEAR(shape.N[other], node == other ? 1.0 : 0.0, 1e-15);
    }
  }
}

TEST_P(SolidShapes, ReproduceLinearFieldsAndTheirSlopes) {
  const SolidTopology& element = solid_topology(GetParam());
  const Vector3d at(0.21, 0.17, 0.35);
  const SolidShape shape = solid_shape(GetParam(), at);
  EXPECT_NEAR(shape.N.sum(), 1.0, 1e-15);
  EXPECT_LE((element.natural * shape.N - at).norm(), 1e-15);
  EXPECT_LE(shape.slope.rowwise().sum().norm(), 1e-14);
  constexpr double h = 1e-5;  // central differences: h² of the third derivative, about 1e-10
  for (int a = 0; a < 3; ++a) {
    const Vector3d step = h * Vector3d::Unit(a);
    const NodeValues slope =
        (solid_shape(GetParam(), at + step).N - solid_shape(GetParam(), at - step).N) / (2 * h);
    EXPECT_LE((slope.transpose() - shape.slope.row(a)).norm(), 1e-9);
  }
}

// Every edge of a face is run through once in each direction, so that the faces close the element
// and look outwards.
TEST_P(SolidShapes, FacesCloseTheElementAndLookOutwards) {
  const SolidTopology& element = solid_topology(GetParam());
  std::map<std::pair<int, int>, int> passed;
  for (const SolidFace& face : element.faces) {
    Vector3d middle = Vector3d::Zero();
    for (std::size_t k = 0; k < face.corners.size(); ++k) {
      const int a = face.corners[k], b = face.corners[(k + 1) % face.corners.size()];
      ++passed[{a, b}];
      middle += element.natural.col(a) / static_cast<double>(face.corners.size());
      if (face.mid_sides.empty()) continue;
      const Vector3d mid_side = 0.5 * (element.natural.col(a) + element.natural.col(b));
      EXPECT_LE((element.natural.col(face.mid_sides[k]) - mid_side).norm(), 1e-15);
    }
    const Vector3d a = element.natural.col(face.corners[0]);
    const Vector3d b = element.natural.col(face.corners[1]);
    const Vector3d c = element.natural.col(face.corners[2]);
    EXPECT_GT((b - a).cross(c - a).dot(middle - element.centre), 0.0);
  }
  EXPECT_EQ(passed.size(), 2 * element.edges.size());
  for (const auto& [edge, count] : passed) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(passed.count({edge.second, edge.first}), 1u);
  }
}

INSTANTIATE_TEST_SUITE_P(All, SolidShapes,
                         testing::Values(SolidKind::hex8, SolidKind::hex20, SolidKind::tet4,
                                         SolidKind::wedge6, SolidKind::wedge15, SolidKind::pyramid5,
                                         SolidKind::tet10),
                         [](const auto& kind) {
                           return choice_names(kind.param)[static_cast<std::size_t>(kind.param)];
                         });

double integral(const QuadratureRule& rule, int p, int q, int r) {
  double sum = 0;
  for (const QuadraturePoint& point : rule) {
    sum += point.weight * std::pow(point.natural.x(), p) * std::pow(point.natural.y(), q) *
           std::pow(point.natural.z(), r);
  }
  return sum;
}

double of_cube(int p, int q, int r) {
  const auto line = [](int k) { return k % 2 == 0 ? 2.0 / (k + 1) : 0.0; };
  return line(p) * line(q) * line(r);
}

/// ∫ x^p y^q z^r over the unit tetrahedron: p! q! r! / (p + q + r + 3)!
double of_tetrahedron(int p, int q, int r) {
  return std::tgamma(p + 1) * std::tgamma(q + 1) * std::tgamma(r + 1) / std::tgamma(p + q + r + 4);
}

TEST(Quadrature, CubeRulesIntegrateTheirDegree) {
  for (int n = 1; n <= 6; ++n) {
    for (int p = 0; p < 2 * n; ++p) {
      EXPECT_NEAR(integral(cube_rule(n), p, 2 * n - 1 - p, 0), of_cube(p, 2 * n - 1 - p, 0), 1e-13);
      EXPECT_NEAR(integral(cube_rule(n), p, p, p), of_cube(p, p, p), 1e-13);
    }
    EXPECT_GT(std::abs(integral(cube_rule(n), 2 * n, 0, 0) - of_cube(2 * n, 0, 0)), 1e-6);
  }
}

TEST(Quadrature, TetrahedronRulesIntegrateTheirDegree) {
  const auto check = [](const QuadratureRule& rule, int degree) {
    for (int p = 0; p <= degree; ++p) {
      for (int q = 0; p + q <= degree; ++q) {
        for (int r = 0; p + q + r <= degree; ++r) {
          EXPECT_NEAR(integral(rule, p, q, r), of_tetrahedron(p, q, r), 1e-15)
              << p << q << r << " of degree " << degree;
        }
      }
    }
  };
  for (int n = 1; n <= 5; ++n) check(conical_rule(n), 2 * n - 1);
  check(symmetric_tetrahedron_rule(), 5);
}

}  // namespace
}  // namespace buckens::fem
