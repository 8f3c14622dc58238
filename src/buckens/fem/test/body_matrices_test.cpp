// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/assembly/body_matrices.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/fem/constraint/coupled_nodes.h"
#include "buckens/fem/test/solid_fixture.h"

namespace buckens::fem {
namespace {

using linalg::Matrix;
using linalg::SparseMatrix;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

BodyMatrices matrices_of(const FeModel& fe) {
  BodyMatrices out;
  out.nodes = fe.nodes;
  for (std::size_t k = 0; k < fe.nodes.size(); ++k) {
    out.numbers.push_back(static_cast<std::int64_t>(k));
  }
  out.dofs = fe.dofs;
  out.M = fe.M.whole();
  out.K = fe.K.whole();
  return out;
}

/// A straight chain of beams in an arbitrary direction with a disc on it.
Structure rotor(int elements, double rho, bool with_disc) {
  Structure s;
  BeamProperties beam = BeamProperties::of(Material::isotropic(2.1e11, 0.3, rho),
                                           Section::circle(0.02), BeamTheory::euler_bernoulli);
  const Eigen::Matrix3d R = test::some_rotation();
  const int a = add_node(s, "a", R * Eigen::Vector3d(0.1, 0.0, 0.0));
  const int b = add_node(s, "b", R * Eigen::Vector3d(0.7, 0.0, 0.0));
  const BeamDivision division = add_beam(s, a, b, elements, beam);
  if (!with_disc) return s;
  const Eigen::Vector3d disc(0.08, 0.05, 0.03);  // no two moments alike, and no plane disc
  s.masses.add(division.nodes[1], 4.0, R * disc.asDiagonal() * R.transpose());
  s.masses.add(b, 1.5, R * Eigen::Vector3d(0.02, 0.02, 0.02).asDiagonal() * R.transpose());
  s.masses.add(a, 0.5);
  return s;
}

Matrix W(const ShapeIntegrals& shape, std::size_t k, const DofMap& dofs) {
  static constexpr std::array<std::array<int, 2>, 6> kPairs = {
      {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};
  Matrix out = shape.W[k];
  if (out.size() == 0) out = Matrix::Zero(dofs.num_dofs, dofs.num_dofs);
  if (shape.nodal.empty()) return out;
  const auto [a, b] = kPairs[k];
  for (int column = 0; column < shape.nodal.Ms->outerSize(); ++column) {
    for (SparseMatrix::InnerIterator it(*shape.nodal.Ms, column); it; ++it) {
      out(shape.nodal.dofs[static_cast<std::size_t>(it.row())][static_cast<std::size_t>(a)],
          shape.nodal.dofs[static_cast<std::size_t>(column)][static_cast<std::size_t>(b)]) +=
          it.value();
    }
  }
  return out;
}

/// Everything that must hold whatever the mass matrix is.
void expect_consistent(const BodyMatrices& body, const FeModel& fe) {
  const Matrix M = body.M;
  const double size = M.norm();
  const Matrix sum = W(fe.shape, 0, fe.dofs) + W(fe.shape, 1, fe.dofs) + W(fe.shape, 2, fe.dofs);
  EXPECT_LT((sum - M).norm(), 1e-14 * size);
  const Matrix Phi = test::rigid_motions(fe);
  const Matrix P = M * Phi;
  const Matrix& c = fe.shape.c;
  for (const auto& [a, b, axis] : {std::array{0, 1, 2}, std::array{1, 2, 0}, std::array{2, 0, 1}}) {
    const linalg::Vector skew = c.col(3 * a + b) - c.col(3 * b + a);
    EXPECT_LT((skew - P.col(3 + axis)).norm(), 1e-12 * P.col(3 + axis).norm());
  }
  const Matrix S = Phi.transpose() * P;
  EXPECT_LT((S.bottomRightCorner(3, 3) - fe.shape.J0).norm(), 1e-12 * fe.shape.J0.norm());
  EXPECT_LT(S.topRightCorner(3, 3).norm(), 1e-12 * fe.shape.mass);  // about the mass centre
}

TEST(BodyMatrices, SolidsHaveTheIntegralsOfTheirElements) {
  for (const SolidForm& form : test::all_forms()) {
    SCOPED_TRACE(test::form_name(form));
    const FeModel fe = assemble(test::distorted_block(form));
    const BodyMatrices body = matrices_of(fe);
    const FeModel own = assemble(body, {});
    EXPECT_NEAR(own.shape.mass, fe.shape.mass, 1e-12 * fe.shape.mass);
    EXPECT_LT((own.shape.com - fe.shape.com).norm(), 1e-13);
    EXPECT_LT((own.shape.J0 - fe.shape.J0).norm(), 1e-12 * fe.shape.J0.norm());
    EXPECT_LT((own.shape.C0 - fe.shape.C0).norm(), 1e-12 * fe.shape.C0.norm());
    EXPECT_LT((own.shape.c - fe.shape.c).norm(), 1e-12 * fe.shape.c.norm());
    const SparseMatrix rest = *own.shape.nodal.Ms - *fe.shape.nodal.Ms;
    EXPECT_LT(rest.norm(), 1e-13 * fe.shape.nodal.Ms->norm());
    expect_consistent(body, own);
  }
}

TEST(BodyMatrices, MassesWithInertiaOnNodesHaveTheirIntegrals) {
  const FeModel fe = assemble(rotor(4, 0.0, true));
  const BodyMatrices body = matrices_of(fe);
  const FeModel own = assemble(body, {});
  EXPECT_LT((own.shape.C0 - fe.shape.C0).norm(), 1e-12 * fe.shape.C0.norm());
  EXPECT_LT((own.shape.c - fe.shape.c).norm(), 1e-12 * fe.shape.c.norm());
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_LT((W(own.shape, k, own.dofs) - W(fe.shape, k, fe.dofs)).norm(),
              1e-13 * fe.M.whole().norm());
  }
  expect_consistent(body, own);
}

TEST(BodyMatrices, StraightBeamsHaveTheirFirstMomentsAndNearlyTheirProducts) {
  // With rotary inertia of the round section every material point counts in both.
  Structure s = rotor(6, 7850.0, true);
  const FeModel plain = assemble(s);
  const FeModel own = assemble(matrices_of(plain), {});
  expect_consistent(matrices_of(plain), own);
  // Along the beam its end nodes take the first moment of bending, too: 9/420 ρA l² at either end.
  // The torsional inertia of the section, in c here but not there, is a hundredth of that.
  const double l = 0.1;
  const double end = 9.0 / 420.0 * 7850.0 * 1e-4 * 3.14159265 * l * l;
  EXPECT_LT((own.shape.c - plain.shape.c).norm(), 1.02 * std::sqrt(2.0) * end);
  for (std::size_t k = 3; k < 6; ++k) {
    // Mean of 1/3 and 13/35 instead of 7/20, and of 1/6 and 9/70 instead of 3/20: 2 %.
    const Matrix exact = W(plain.shape, k, plain.dofs);
    EXPECT_LT((W(own.shape, k, own.dofs) - exact).norm(), 0.02 * exact.norm());
  }
}

TEST(BodyMatrices, FramesOfBeamsAndBarsStayConsistent) {
  const BeamProperties beam = test::beam_properties(BeamTheory::timoshenko, true);
  const FeModel fe = assemble(test::frame_structure(beam, test::some_rotation()));
  const BodyMatrices body = matrices_of(fe);
  const FeModel own = assemble(body, {});
  expect_consistent(body, own);
  EXPECT_NEAR(own.shape.mass, fe.shape.mass, 1e-12 * fe.shape.mass);
  EXPECT_LT((own.shape.J0 - fe.shape.J0).norm(), 1e-12 * fe.shape.J0.norm());
}

TEST(BodyMatrices, DampingMayHaveAShareOfTheMass) {
  const FeModel fe = assemble(rotor(3, 7850.0, true));
  BodyMatrices body = matrices_of(fe);
  body.C = 2.5 * body.M + 1e-6 * body.K;
  const FeModel own = assemble(body, {});
  EXPECT_NEAR(own.mass_damping, 2.5, 1e-9);
  const SparseMatrix rest = own.K_damping.whole() - 1e-6 * fe.K.whole();
  EXPECT_LT(rest.norm(), 1e-9 * 1e-6 * fe.K.whole().norm());
  const FeModel rayleigh = assemble(matrices_of(fe), {3.0, 2e-6});
  EXPECT_EQ(rayleigh.mass_damping, 3.0);
  const SparseMatrix difference = rayleigh.K_damping.whole() - 2e-6 * fe.K.whole();
  EXPECT_EQ(difference.norm(), 0.0);
}

TEST(BodyMatrices, DampingMayBeAShareOfTheMassAlone) {
  const FeModel fe = assemble(rotor(3, 7850.0, true));
  for (int k = 1; k <= 40; ++k) {
    const double alpha = 0.173 * k;  // some of these are found with rounding
    BodyMatrices body = matrices_of(fe);
    body.C = alpha * body.M;
    const FeModel own = assemble(body, {});
    EXPECT_NEAR(own.mass_damping, alpha, 1e-13);
    EXPECT_LT(own.K_damping.whole().norm(), 1e-13 * body.C.norm());
  }
}

TEST(BodyMatrices, EmptyMatricesAreRefused) {
  const FeModel fe = assemble(rotor(3, 7850.0, true));
  BodyMatrices body = matrices_of(fe);
  body.K *= 0.0;
  EXPECT_THAT([&] { assemble(body, {}); },
              ThrowsMessage<ModelError>(HasSubstr("stiffness matrix is zero")));
}

TEST(BodyMatrices, MatricesOfHeldBodiesAreRefusedWithTheDirection) {
  const FeModel fe = assemble(rotor(3, 7850.0, true));
  BodyMatrices body = matrices_of(fe);
  body.K.coeffRef(1, 1) += 1e6;
  EXPECT_THAT([&] { assemble(body, {}); },
              ThrowsMessage<ModelError>(AllOf(HasSubstr("stiffness matrix resists"),
                                              HasSubstr("along y"), HasSubstr("\"a\""))));
  body = matrices_of(fe);
  body.C = SparseMatrix(fe.M.rows(), fe.M.cols());
  body.C.insert(0, 0) = 5.0;
  EXPECT_THAT([&] { assemble(body, {}); },
              ThrowsMessage<ModelError>(HasSubstr("damping matrix resists")));
}

TEST(BodyMatrices, MassMatricesThatNoBodyHasAreRefused) {
  const FeModel fe = assemble(rotor(3, 7850.0, true));
  BodyMatrices body = matrices_of(fe);
  body.M.coeffRef(2, 2) += 0.1;
  EXPECT_THAT([&] { assemble(body, {}); },
              ThrowsMessage<ModelError>(HasSubstr("different masses along x, y, z")));
  body = matrices_of(fe);
  body.M.coeffRef(4, 4) = -1.0;
  EXPECT_THAT([&] { assemble(body, {}); },
              ThrowsMessage<ModelError>(
                  AllOf(HasSubstr("mass matrix has -1"), HasSubstr("rotation y of node \"a\""))));
  body = matrices_of(fe);
  std::swap(body.M, body.K);
  EXPECT_THROW(assemble(body, {}), ModelError);
  body = matrices_of(fe);
  body.M.coeffRef(0, 1) = body.M.coeffRef(1, 0) = 1e3;
  EXPECT_THAT([&] { assemble(body, {}); },
              ThrowsMessage<ModelError>(HasSubstr("exceeds the root")));
}

TEST(CoupledNodes, BeamsGiveTheirChainAndHexahedraTheirEdges) {
  EXPECT_EQ(coupled_nodes(assemble(rotor(5, 7850.0, false))).size(), 5u);
  Structure s;
  add_box(s, {{0, 0, 0}, {2, 1, 1}, {2, 1, 1}}, test::steel(), SolidForm::usual(SolidKind::hex8));
  EXPECT_EQ(coupled_nodes(assemble(s)).size(), 20u);
}

}  // namespace
}  // namespace buckens::fem
