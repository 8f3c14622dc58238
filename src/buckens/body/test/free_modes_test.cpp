// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/free_modes.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/body/fixed_interface_modes.h"
#include "buckens/body/free_free_modes.h"
#include "buckens/body/rigid_modes.h"
#include "buckens/fem/assembly/assemble.h"

namespace buckens::body {
namespace {

using linalg::Matrix;
using linalg::SparseMatrix;
using linalg::Vector;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

fem::FeModel straight_beam(int divisions, double rho = 7850.0) {
  fem::Structure s;
  fem::add_node(s, "start", {0.1, 0, 0});
  fem::add_node(s, "end", {0.1 + 0.6, 0.8, 0});
  fem::add_beam(s, 0, 1, divisions,
                fem::BeamProperties::of(fem::Material::isotropic(2.1e11, 0.3, rho),
                                        fem::Section::rectangle(0.02, 0.01),
                                        fem::BeamTheory::euler_bernoulli));
  if (rho == 0.0) {
    for (int node = 0; node <= divisions; ++node) s.masses.add(node, 0.5);
  }
  return fem::assemble(s);
}

Matrix rigid(const fem::FeModel& fe) {
  std::vector<Eigen::Vector3d> positions;
  for (const auto& node : fe.nodes) positions.push_back(node.position);
  return rigid_modes(positions, fe.dofs, fe.shape.com);
}

void expect_modes_solve(const fem::FeModel& fe, const FreeModes& modes, double tolerance) {
  const Matrix identity = modes.shapes.transpose() * (fe.M * modes.shapes);
  EXPECT_LE((identity - Matrix::Identity(identity.rows(), identity.cols())).norm(), tolerance);
  const Matrix strain = modes.shapes.transpose() * (fe.K * modes.shapes);
  const Matrix squares = modes.omega.cwiseAbs2().asDiagonal();
  EXPECT_LE((strain - squares).norm(), tolerance * squares.norm());
  const Matrix left = rigid(fe).transpose() * (fe.M * modes.shapes);
  EXPECT_LE(left.norm(), tolerance);
}

TEST(FreeModes, SmallBodiesGiveAllElasticModes) {
  const fem::FeModel fe = straight_beam(6);
  const FreeModes modes = free_modes(fe.M, fe.K, rigid(fe), 1000);
  EXPECT_EQ(modes.omega.size(), fe.dofs.num_dofs - 6);
  expect_modes_solve(fe, modes, 1e-9);
}

TEST(FreeModes, LargeBodiesGiveTheSameFrequencies) {
  // 120 elements, 726 DOF: Lanczos. Analytic values, f ~ (βL)², weak and strong bending.
  const fem::FeModel fe = straight_beam(120);
  const FreeModes modes = free_modes(fe.M, fe.K, rigid(fe), 6);
  ASSERT_EQ(modes.omega.size(), 6);
  const double weak = std::sqrt(2.1e11 * 0.01 * 0.01 / 12 / 7850.0);
  const std::array<double, 3> betas = {4.730040744862704, 7.853204624095838, 10.995607838001671};
  std::vector<double> expected;
  for (const double beta : betas) {
    expected.push_back(beta * beta * weak);
    expected.push_back(2 * beta * beta * weak);
  }
  expected.push_back(14.137165491257464 * 14.137165491257464 * weak);
  std::sort(expected.begin(), expected.end());
  for (Eigen::Index k = 0; k < 6; ++k) {
    // Discretisation 1e-8; rounding of K, ε (ω_max/ω)² ~ 1e-6 for the lowest.
    EXPECT_NEAR(modes.omega[k], expected[static_cast<std::size_t>(k)], 3e-6 * modes.omega[k]) << k;
  }
  expect_modes_solve(fe, modes, 1e-5);
}

TEST(FreeModes, BothRoutesAgreeNearTheirBorder) {
  const fem::FeModel fe = straight_beam(101);  // 612 DOF
  const FreeModes few = free_modes(fe.M, fe.K, rigid(fe), 8);
  const FreeModes many = free_modes(fe.M, fe.K, rigid(fe), 300);  // too many for Lanczos: dense
  for (Eigen::Index k = 0; k < 8; ++k) {
    EXPECT_NEAR(few.omega[k], many.omega[k], 1e-5 * many.omega[k]) << k;
  }
}

TEST(FreeModes, VariablesWithoutMassAreNoModes) {
  const fem::FeModel fe = straight_beam(2, 0.0);
  // Three masses of 0.5 kg; a beam that bends without inertia of its own: spring 48 E I / L³
  // against the reduced mass, in two planes, and two axial modes. Rotations have no mass.
  const FreeModes modes = free_modes(fe.M, fe.K, rigid(fe), 100);
  const double EI = 2.1e11 * 0.02 * std::pow(0.01, 3) / 12;
  const double reduced = 1.0 / (1.0 / 1.0 + 1.0 / 0.5);  // two ends against the middle
  ASSERT_EQ(modes.omega.size(), 4);
  EXPECT_NEAR(modes.omega[0], std::sqrt(48 * EI / reduced), 1e-9 * modes.omega[0]);
  EXPECT_NEAR(modes.omega[1], 2 * modes.omega[0], 1e-9 * modes.omega[1]);
  const double EA = 2.1e11 * 0.02 * 0.01;
  EXPECT_NEAR(modes.omega[2], std::sqrt(EA / 0.5 / 0.5), 1e-9 * modes.omega[2]);
  EXPECT_NEAR(modes.omega[3], std::sqrt(3 * EA / 0.5 / 0.5), 1e-9 * modes.omega[3]);
}

TEST(FreeModes, NothingElasticGivesNothing) {
  fem::Structure s;
  fem::add_node(s, "a", {0, 0, 0});
  fem::add_node(s, "b", {1, 0, 0});
  s.bars.add(0, 1, fem::Material::isotropic(2.1e11, 0.3, 7850.0), fem::Section::area(1e-4));
  const fem::FeModel fe = fem::assemble(s);
  const FreeModes modes = free_modes(fe.M, fe.K, rigid(fe), 10);
  ASSERT_EQ(modes.omega.size(), 1);  // six variables, five rigid motions of a line
  EXPECT_NEAR(modes.omega[0], std::sqrt(12 * 2.1e11 / 7850.0), 1e-9 * modes.omega[0]);
  EXPECT_EQ(free_modes(fe.M, fe.K, rigid(fe), 0).omega.size(), 0);
}

TEST(FreeModes, SoManyOfALargeBodyThatOnlyFullMatricesGiveThemAreRefused) {
  // 4806 variables: full matrices would take 185 MB each; of 60 000 variables they take 29 GB.
  FlexiblePart part("long", straight_beam(800), CouplingLevel::full);
  part.rows.resize(0, part.num_dofs());
  const auto refused = ThrowsMessage<ModelError>(
      AllOf(HasSubstr("2000 vibrations of a mesh of 4806 variables"), HasSubstr("at most 1201")));
  EXPECT_THAT([&] { free_modes(part.fe.M, part.fe.K, part.sieve.Phi(), 2000); }, refused);
  EXPECT_THAT([&] { free_free_modes(part, 2000); }, refused);
  EXPECT_THAT([&] { fixed_interface_modes(part, 2000); }, refused);
}

}  // namespace
}  // namespace buckens::body
