// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/assembly/assemble.h"

#include <Eigen/Eigenvalues>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/fem/test/fixture.h"

namespace buckens::fem::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using linalg::Matrix;
using linalg::Vector;

struct AssembleCase {
  BeamTheory theory;
  bool rotary;
};

class AssembleTest : public testing::TestWithParam<AssembleCase> {
 protected:
  BeamProperties properties() const {
    return beam_properties(GetParam().theory, GetParam().rotary);
  }
};

TEST_P(AssembleTest, MassIsPositiveAndStiffnessHasSixZeroModes) {
  const FeModel fe = assemble(frame_structure(properties(), some_rotation()));
  const Matrix M = fe.M.whole();
  const Matrix K = fe.K.whole();
  EXPECT_EQ((M - M.transpose()).norm(), 0.0);
  EXPECT_EQ((K - K.transpose()).norm(), 0.0);
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix>(M).eigenvalues().minCoeff(), 0.0);
  const Vector k = Eigen::SelfAdjointEigenSolver<Matrix>(K).eigenvalues();
  EXPECT_LE(k.head(6).cwiseAbs().maxCoeff(), 1e-14 * k.maxCoeff());
  // The softest elastic mode of this frame is eight orders above rounding.
  EXPECT_GT(k[6], 1e-8 * k.maxCoeff());
  const Matrix Q = rigid_motions(fe);
  EXPECT_LE((K * Q).norm(), 1e-14 * K.norm() * Q.norm());
}

TEST_P(AssembleTest, RigidMotionCarriesTheBodysMassAndInertia) {
  const FeModel fe = assemble(frame_structure(properties(), Matrix3d::Identity()));
  const Matrix Q = rigid_motions(fe);
  Matrix expected = Matrix::Zero(6, 6);
  expected.topLeftCorner<3, 3>() = fe.shape.mass * Matrix3d::Identity();
  expected.bottomRightCorner<3, 3>() = fe.shape.J0;
  EXPECT_LE((Q.transpose() * fe.M.whole() * Q - expected).norm(), 1e-14 * expected.norm());
}

TEST_P(AssembleTest, MomentsOfTheShapeVectorsAreRowsOfTheRigidModes) {
  // e_a·∫ s0 × g dm = c_bc − c_cb = (M Q_a)ᵀ; flywheels are in M only: here subtracted.
  const FeModel fe = assemble(frame_structure(properties(), some_rotation()));
  linalg::SparseMatrix line = fe.shape.W[0] + fe.shape.W[1];
  line += fe.shape.W[2];
  const Matrix P = line * rigid_motions(fe);
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3;
    const int c = (a + 2) % 3;
    const Vector moment = fe.shape.c.col(3 * b + c) - fe.shape.c.col(3 * c + b);
    EXPECT_LE((moment - P.col(3 + a)).norm(), 1e-14 * P.rightCols<3>().norm()) << a;
  }
  if (GetParam().rotary) {
    EXPECT_LE((fe.M.whole() - line).norm(), 1e-15 * fe.M.whole().norm());
  }
}

TEST_P(AssembleTest, TurningTheStructureTurnsEverything) {
  const Matrix3d R = some_rotation();
  const FeModel one = assemble(frame_structure(properties(), Matrix3d::Identity()));
  const FeModel two = assemble(frame_structure(properties(), R));
  const int n = one.dofs.num_dofs;
  Matrix T = Matrix::Zero(n, n);
  for (const auto& dofs : one.dofs.node_dofs) {
    T.block<3, 3>(dofs[0], dofs[0]) = R;
    if (dofs[3] >= 0) T.block<3, 3>(dofs[3], dofs[3]) = R;
  }
  const Matrix M = T * one.M.whole() * T.transpose();
  const Matrix K = T * one.K.whole() * T.transpose();
  EXPECT_LE((M - Matrix(two.M.whole())).norm(), 1e-14 * M.norm());
  EXPECT_LE((K - Matrix(two.K.whole())).norm(), 1e-14 * K.norm());
  EXPECT_LE((R * one.shape.J0 * R.transpose() - two.shape.J0).norm(), 1e-14 * two.shape.J0.norm());
  EXPECT_LE((R * one.shape.com - two.shape.com).norm(), 1e-15);
  // c_ab turns as a tensor in (a, b) and as nodal vectors in its rows.
  Matrix turned = Matrix::Zero(n, 9);
  for (int ab = 0; ab < 9; ++ab) {
    for (int cd = 0; cd < 9; ++cd) {
      turned.col(ab) += R(ab / 3, cd / 3) * R(ab % 3, cd % 3) * (T * one.shape.c.col(cd));
    }
  }
  EXPECT_LE((turned - two.shape.c).norm(), 1e-14 * turned.norm());
}

TEST_P(AssembleTest, PlanarIsTheRestrictionOfSpatial) {
  for (const auto plane : {spatial::Plane::xy, spatial::Plane::yz, spatial::Plane::zx}) {
    const Structure structure = frame_structure(properties(), Matrix3d::Identity());
    const FeModel spatial_model = assemble(structure);
    const FeModel planar = assemble(structure, plane);
    const auto normal = static_cast<std::size_t>(spatial::normal_index(plane));
    Matrix select = Matrix::Zero(spatial_model.dofs.num_dofs, planar.dofs.num_dofs);
    for (std::size_t node = 0; node < structure.nodes.size(); ++node) {
      for (std::size_t k = 0; k < 6; ++k) {
        const int full = spatial_model.dofs.node_dofs[node][k];
        const int kept = planar.dofs.node_dofs[node][k];
        const bool in_plane = k < 3 ? k != normal : k == normal + 3;
        EXPECT_EQ(kept >= 0, in_plane && full >= 0);
        if (kept >= 0) select(full, kept) = 1;
      }
    }
    const Matrix M = select.transpose() * spatial_model.M.whole() * select;
    const Matrix K = select.transpose() * spatial_model.K.whole() * select;
    EXPECT_EQ((M - Matrix(planar.M.whole())).norm(), 0.0);
    EXPECT_EQ((K - Matrix(planar.K.whole())).norm(), 0.0);
    EXPECT_EQ((select.transpose() * spatial_model.shape.c - planar.shape.c).norm(), 0.0);
    EXPECT_EQ((spatial_model.shape.J0 - planar.shape.J0).norm(), 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Beams, AssembleTest,
                         testing::Values(AssembleCase{BeamTheory::euler_bernoulli, false},
                                         AssembleCase{BeamTheory::euler_bernoulli, true},
                                         AssembleCase{BeamTheory::timoshenko, false},
                                         AssembleCase{BeamTheory::timoshenko, true}));

Structure straight(int divisions, const BeamProperties& properties, double length) {
  Structure s;
  add_node(s, "start", {0.3, 0, 0});
  add_node(s, "end", {0.3 + length, 0, 0});
  add_beam(s, 0, 1, divisions, properties);
  return s;
}

TEST(Assemble, RotaryInertiaOfASlenderAndAThickBlock) {
  for (const double length : {3.0, 0.06}) {
    const FeModel fe = assemble(straight(3, beam_properties(BeamTheory::timoshenko, true), length));
    const double mass = 7850.0 * kWidth * kHeight * length;
    EXPECT_NEAR(fe.shape.mass, mass, 1e-14 * mass);
    EXPECT_NEAR(fe.shape.com.x(), 0.3 + 0.5 * length, 1e-14);
    const double x2 = length * length;
    const double y2 = kWidth * kWidth;  // local y is global y: up is z
    const double z2 = kHeight * kHeight;
    const Vector3d J0 = mass / 12 * Vector3d(y2 + z2, x2 + z2, x2 + y2);
    EXPECT_LE((fe.shape.J0 - Matrix3d(J0.asDiagonal())).norm(), 1e-14 * J0.norm());
  }
}

TEST(Assemble, RotaryInertiaOfALineWithFlywheels) {
  const FeModel fe = assemble(straight(5, beam_properties(BeamTheory::euler_bernoulli, false), 2));
  const double mass = 7850.0 * kWidth * kHeight * 2;
  const double about_axis = mass / 12 * (kWidth * kWidth + kHeight * kHeight);
  const Vector3d J0(about_axis, mass / 3, mass / 3);
  EXPECT_LE((fe.shape.J0 - Matrix3d(J0.asDiagonal())).norm(), 1e-14 * J0.norm());
}

TEST(Assemble, NumbersTheVariablesOfBeamsAndBars) {
  const FeModel fe = assemble(
      frame_structure(beam_properties(BeamTheory::euler_bernoulli, false), some_rotation()));
  EXPECT_EQ(fe.dofs.num_dofs, 4 * 6 + 3);
  EXPECT_GE(fe.dofs.node_dofs[0][5], 0);   // a: beam and bar
  EXPECT_EQ(fe.dofs.node_dofs[4][3], -1);  // d: bars only
}

TEST(Assemble, DampingIsSummedPerMaterial) {
  BeamProperties properties = beam_properties(BeamTheory::euler_bernoulli, false);
  Structure s = straight(2, properties, 1);
  EXPECT_EQ(assemble(s).K_damping.nonZeros(), 0);
  properties.material.damping_stiffness = 1e-5;
  const int far = add_node(s, "far", {0.3, 1, 0});
  add_beam(s, 0, far, 1, properties);
  const FeModel fe = assemble(s);
  const FeModel damped_part = assemble(straight(1, properties, 1));
  // Only the second beam is damped, and a rotation about z keeps its norm.
  EXPECT_NEAR(fe.K_damping.whole().norm(), 1e-5 * damped_part.K.whole().norm(),
              1e-13 * fe.K_damping.whole().norm());
  properties.material.damping_mass = 0.3;
  EXPECT_EQ(assemble(straight(1, properties, 1)).mass_damping, 0.3);
}

TEST(Assemble, PartsWithoutMassCountInStiffnessOnly) {
  Structure s = straight(2, beam_properties(BeamTheory::euler_bernoulli, false), 1);
  const FeModel bare = assemble(s);
  Material massless = steel();
  massless.rho = 0;
  s.bars.add(0, 1, massless, Section::circle(0.01));
  const FeModel fe = assemble(s);
  EXPECT_EQ((fe.M.whole() - bare.M.whole()).norm(), 0.0);
  EXPECT_GT((fe.K.whole() - bare.K.whole()).norm(), 0.0);
}

/// The message of the ModelError that assembling must throw.
std::string refusal(const Structure& structure) {
  try {
    assemble(structure);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "(accepted)";
}

TEST(Assemble, RefusesNodesAndPartsThatHangOnNothing) {
  const BeamProperties properties = beam_properties(BeamTheory::euler_bernoulli, false);
  Structure s = straight(1, properties, 1);
  add_node(s, "stray", {0, 1, 0});
  EXPECT_THAT(refusal(s), testing::HasSubstr("node \"stray\" is connected to no element"));
  add_node(s, "other", {0, 2, 0});
  s.bars.add(2, 3, steel(), Section::circle(0.01));
  EXPECT_THAT(refusal(s), testing::HasSubstr("parts that nothing holds together"));
}

TEST(Assemble, RefusesElementsThatCannotBe) {
  BeamProperties properties = beam_properties(BeamTheory::euler_bernoulli, false);
  EXPECT_THAT(refusal(straight(1, properties, 0)), testing::HasSubstr("both ends lie at"));
  properties.up = Vector3d(-2, 0, 0);
  EXPECT_THAT(refusal(straight(1, properties, 1)), testing::HasSubstr("is parallel"));
  properties.up.reset();
  properties.material.rho = 0;
  EXPECT_THAT(refusal(straight(1, properties, 1)), testing::HasSubstr("no mass"));
  properties.material.rho = -1;
  EXPECT_THAT(refusal(straight(1, properties, 1)), testing::HasSubstr("rho = -1"));
  properties = beam_properties(BeamTheory::euler_bernoulli, false);
  Structure s = straight(1, properties, 1);
  properties.material.damping_mass = 1;
  add_beam(s, 1, add_node(s, "tip", {2, 2, 2}), 1, properties);
  EXPECT_THAT(refusal(s), testing::HasSubstr("one value per body"));
}

TEST(Assemble, RefusesInertiaWhereNothingTurns) {
  Structure s;
  add_node(s, "a", {0, 0, 0});
  add_node(s, "b", {1, 0, 0});
  s.bars.add(0, 1, steel(), Section::circle(0.01));
  s.masses.add(1, 1.0, 0.1 * Matrix3d::Identity());
  EXPECT_THAT(refusal(s), testing::HasSubstr("mass at node \"b\": the node has no rotations"));
}

TEST(Structure, RefusesDuplicateNames) {
  Structure s;
  add_node(s, "a", {0, 0, 0});
  EXPECT_THROW(add_node(s, "a", {1, 0, 0}), ModelError);
}

}  // namespace
}  // namespace buckens::fem::test
