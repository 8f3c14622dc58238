// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/sieve.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/body/body.h"
#include "buckens/body/rigid_modes.h"
#include "buckens/fem/test/fixture.h"

namespace buckens::body {
namespace {

using linalg::Matrix;
using linalg::Vector;
using testing::HasSubstr;

fem::FeModel frame() {
  return fem::assemble(fem::test::frame_structure(
      fem::test::beam_properties(fem::BeamTheory::euler_bernoulli, false),
      fem::test::some_rotation()));
}

std::vector<Eigen::Vector3d> positions(const fem::FeModel& fe) {
  std::vector<Eigen::Vector3d> out;
  for (const auto& node : fe.nodes) out.push_back(node.position);
  return out;
}

class SieveOfFrame : public testing::Test {
 protected:
  SieveOfFrame()
      : fe(frame()), Phi(rigid_modes(positions(fe), fe.dofs, fe.shape.com)), sieve(Phi, fe.M) {
    Y = Matrix::Identity(fe.M.rows(), fe.M.rows());
    sieve.apply(Y);
  }
  fem::FeModel fe;
  Matrix Phi;
  Sieve sieve;
  Matrix Y;  // formed here only
};

TEST_F(SieveOfFrame, RigidModesAreThoseOfAnotherRoute) {
  EXPECT_LE((Phi - fem::test::rigid_motions(fe)).norm(), 1e-15 * Phi.norm());
}

TEST_F(SieveOfFrame, IsTheProjectionAlongRigidMotion) {
  const Matrix P = fe.M * Phi;
  // 24 n operations on numbers of order one: a hundred roundings.
  EXPECT_LE((Y * Y - Y).norm(), 1e-13 * Y.norm());
  EXPECT_LE((P.transpose() * Y).norm(), 1e-13 * P.norm());
  EXPECT_LE((Y * Phi).norm(), 1e-13 * Phi.norm());
  const Matrix MY = fe.M * Y;
  EXPECT_LE((MY - MY.transpose()).norm(), 1e-13 * MY.norm());
  EXPECT_EQ(sieve.rank(), 6);
  EXPECT_NEAR(Y.trace(), static_cast<double>(fe.M.rows() - 6), 1e-11);
}

TEST_F(SieveOfFrame, EqualsTheFormulaOfThePaper) {
  const Matrix P = fe.M * Phi;
  const Matrix S = P.transpose() * Phi;
  EXPECT_LE((sieve.S() - S).norm(), 1e-14 * S.norm());
  const Matrix expected =
      Matrix::Identity(Y.rows(), Y.cols()) - Phi * S.partialPivLu().solve(P.transpose());
  EXPECT_LE((Y - expected).norm(), 1e-12 * Y.norm());
  // S of the mass matrix is the mass and the rotary inertia of the shape integrals.
  EXPECT_NEAR(S(0, 0), fe.shape.mass, 1e-12 * fe.shape.mass);
  EXPECT_LE((S.bottomRightCorner<3, 3>() - fe.shape.J0).norm(), 1e-12 * fe.shape.J0.norm());
  EXPECT_LE((S.topRightCorner<3, 3>()).norm(), 1e-12 * fe.shape.mass);
}

TEST_F(SieveOfFrame, TransposedActsOnLoads) {
  Vector f = Vector::LinSpaced(Y.rows(), -1.0, 2.0);
  const Vector expected = Y.transpose() * f;
  sieve.apply_transposed(f);
  EXPECT_LE((f - expected).norm(), 1e-13 * expected.norm());
}

TEST_F(SieveOfFrame, RigidPartGivesTranslationsAndRotations) {
  Eigen::Matrix<double, 6, 1> motion;
  motion << 0.3, -0.1, 0.2, 0.05, -0.02, 0.04;
  Vector d = Vector::LinSpaced(Y.rows(), -1.0, 2.0);
  sieve.apply(d);
  d += Phi * motion;
  EXPECT_LE((sieve.rigid_part(d) - motion).norm(), 1e-13);
}

TEST_F(SieveOfFrame, DoesNotDependOnUnits) {
  // Millimetres: rotations of a thousandth of the size.
  Eigen::Matrix<double, 6, 1> scale;
  scale << 1, 1, 1, 1e3, 1e3, 1e3;
  const Sieve other(Phi * scale.asDiagonal(), fe.M.whole());
  Matrix Z = Matrix::Identity(Y.rows(), Y.cols());
  other.apply(Z);
  EXPECT_LE((Z - Y).norm(), 1e-13 * Y.norm());
}

TEST(Sieve, StraightBarHasFiveRigidMotions) {
  fem::Structure s;
  fem::add_node(s, "a", {0, 0, 0});
  fem::add_node(s, "b", {0.6, 0.8, 0.3});
  s.bars.add(0, 1, fem::test::steel(), fem::Section::area(1e-4));
  const fem::FeModel fe = fem::assemble(s);
  const Sieve sieve(rigid_modes(positions(fe), fe.dofs, fe.shape.com), fe.M);
  EXPECT_EQ(sieve.rank(), 5);
}

std::string message_of(fem::FeModel fe) {
  try {
    const FlexiblePart part("arm", std::move(fe), CouplingLevel::full);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "no error";
}

TEST(RigidMotion, ASpringToGroundInsideABodyIsRefusedWithItsNode) {
  EXPECT_EQ(message_of(frame()), "no error");
  fem::FeModel fe = frame();
  const int dof = fe.dofs.node_dofs[2][1];
  linalg::SparseMatrix K = fe.K;
  K.coeffRef(dof, dof) += 1e6;
  fe.K = K;
  const std::string message = message_of(std::move(fe));
  EXPECT_THAT(message, HasSubstr("body \"arm\""));
  EXPECT_THAT(message, HasSubstr("translation y"));
  EXPECT_THAT(message, HasSubstr("joint"));
}

}  // namespace
}  // namespace buckens::body
