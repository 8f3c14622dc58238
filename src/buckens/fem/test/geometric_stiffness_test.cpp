// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/assembly/geometric_stiffness.h"

#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "buckens/fem/assembly/assemble.h"
#include "buckens/fem/structure.h"

namespace buckens::fem {
namespace {

using Eigen::Vector3d;
using linalg::Matrix;
using linalg::Vector;

constexpr double kYoung = 2e11;

/// Beam of 1 m from the origin along `direction`.
Structure beam_along(const Vector3d& direction, int elements) {
  Structure s;
  const int a = add_node(s, "a", Vector3d::Zero());
  const int b = add_node(s, "b", direction.normalized());
  add_beam(s, a, b, elements,
           BeamProperties::of({kYoung, 0.3, 8e10, 7800, 0, 0}, Section::rectangle(0.01, 0.02),
                              BeamTheory::euler_bernoulli));
  return s;
}

TEST(GeometricStiffness, FindsTheBucklingLoadOfACantilever) {
  // Euler: π²EI/(4L²) about the weak axis; eight cubic elements are within 1e-5 of it.
  const double I = 0.02 * 0.01 * 0.01 * 0.01 / 12.0;
  const double expected = 0.25 * std::numbers::pi * std::numbers::pi * kYoung * I;
  for (const Vector3d& direction : {Vector3d(1, 0, 0), Vector3d(1, -2, 3), Vector3d(0, 0, 1)}) {
    const FeModel fe = assemble(beam_along(direction, 8));
    const GeometricStiffness geometric(fe);
    const Matrix G = Matrix(geometric.matrix(Vector::Ones(8)));
    EXPECT_LT((G - G.transpose()).norm(), 1e-14 * G.norm());
    // The clamped node is the first; node "b" is the second.
    const Eigen::Index free = fe.M.rows() - 6;
    const Matrix K = Matrix(fe.K.whole()).bottomRightCorner(free, free);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> eigen(G.bottomRightCorner(free, free),
                                                                 K);
    EXPECT_NEAR(1.0 / eigen.eigenvalues().maxCoeff(), expected, 1e-4 * expected);
  }
}

TEST(GeometricStiffness, TheForceIsThatOfTheAxialForceAtHand) {
  const FeModel fe = assemble(beam_along({1, 2, 2}, 3));
  const GeometricStiffness geometric(fe);
  Vector d = 1e-3 * Vector::Random(fe.M.rows());
  EXPECT_LT((geometric.load(d) + geometric.matrix(geometric.axial_forces(d)) * d).norm(),
            1e-12 * geometric.load(d).norm());
  // Stretched along its line by 1e-4: N = EA 1e-4.
  const Vector3d t = Vector3d(1, 2, 2).normalized();
  d.setZero();
  for (std::size_t n = 0; n < fe.nodes.size(); ++n) {
    const Vector3d u = 1e-4 * t.dot(fe.nodes[n].position) * t;
    for (int k = 0; k < 3; ++k) d[fe.dofs.node_dofs[n][static_cast<std::size_t>(k)]] = u[k];
  }
  const Vector forces = geometric.axial_forces(d);
  for (int e = 0; e < 3; ++e) EXPECT_NEAR(forces[e], kYoung * 2e-4 * 1e-4, 1e-6 * forces[e]);
  EXPECT_LT(geometric.load(d).norm(), 1e-12 * forces[0]) << "a straight line is not turned";
}

TEST(GeometricStiffness, BarsResistBeingTurned) {
  Structure s;
  const int a = add_node(s, "a", Vector3d::Zero());
  const int b = add_node(s, "b", {0, 2, 0});
  s.bars.add(a, b, {kYoung, 0.3, 8e10, 7800, 0, 0}, Section::area(1e-4));
  const FeModel fe = assemble(s);
  const Matrix G = Matrix(GeometricStiffness(fe).matrix(Vector::Ones(1)));
  EXPECT_NEAR(G(0, 0), 0.5, 1e-15);
  EXPECT_NEAR(G(0, 3), -0.5, 1e-15);
  EXPECT_EQ(G(1, 1), 0.0);
}

}  // namespace
}  // namespace buckens::fem
