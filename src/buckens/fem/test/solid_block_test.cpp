// SPDX-License-Identifier: Apache-2.0
// What holds for every kind of solid and every integration.
#include <Eigen/Eigenvalues>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/fem/assembly/assemble.h"
#include "buckens/fem/solid/block.h"
#include "buckens/fem/solid/element.h"
#include "buckens/fem/solid/recovery.h"
#include "buckens/fem/test/solid_fixture.h"

namespace buckens::fem {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using linalg::Matrix;
using linalg::Vector;
using test::distorted_block;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

class Solids : public testing::TestWithParam<SolidForm> {};

// Constant strain in elements with curved edges: no force at inner nodes, Hooke's stress
// everywhere.
TEST_P(Solids, PassThePatchTest) {
  const Structure s = distorted_block(GetParam());
  const FeModel fe = assemble(s);
  Matrix3d slope;
  slope << 1e-3, 2e-4, -3e-4, 5e-4, -4e-4, 1e-4, 2e-4, 6e-4, 7e-4;
  const Vector d = test::nodal_values(fe, [&](const Vector3d& x) { return slope * x; });
  const Vector force = fe.K * d;
  const std::vector<int> inner = test::inner_nodes(s);
  ASSERT_GE(inner.size(), 1u);
  for (const int node : inner) {
    EXPECT_LE(force.segment<3>(3 * node).norm(), 1e-12 * force.norm()) << "node " << node;
  }
  const Matrix3d strain = 0.5 * (slope + slope.transpose());
  const Material steel = test::steel();
  const Matrix3d stress = 2.0 * steel.G * strain + steel.E * steel.nu /
                                                       ((1 + steel.nu) * (1 - 2 * steel.nu)) *
                                                       strain.trace() * Matrix3d::Identity();
  Eigen::Matrix<double, 7, 1> expected;
  const Matrix3d deviator = stress - stress.trace() / 3.0 * Matrix3d::Identity();
  expected << stress(0, 0), stress(1, 1), stress(2, 2), stress(0, 1), stress(1, 2), stress(2, 0),
      std::sqrt(1.5) * deviator.norm();
  const Matrix all = SolidRecovery(fe).stresses(d);
  ASSERT_EQ(all.cols(), s.solids.num_elements());
  for (Eigen::Index e = 0; e < all.cols(); ++e) {
    EXPECT_LE((all.col(e) - expected).norm(), 1e-12 * expected.norm()) << "element " << e;
  }
  // Strain energy: the volume times ½ σ:ε, so incompatible modes stay at rest.
  const double volume = fe.shape.mass / steel.rho;
  const double energy = 0.5 * volume * (stress.array() * strain.array()).sum();
  EXPECT_NEAR(0.5 * d.dot(force), energy, 1e-12 * energy);
}

TEST_P(Solids, HaveSixMotionsWithoutEnergy) {
  Structure s;
  const SolidTopology& topology = solid_topology(GetParam().kind);
  std::vector<int> nodes;
  for (int k = 0; k < topology.num_nodes; ++k) {
    nodes.push_back(k);
    s.nodes.push_back({"", 0.1 * topology.natural.col(k)});
  }
  test::distort(s, test::is_quadratic(GetParam()) ? 0.008 : 0.02);
  s.solids.add(GetParam(), nodes, s.solids.add_material(test::steel()));
  const FeModel fe = assemble(s);
  const Matrix Q = test::rigid_motions(fe);
  EXPECT_LE((fe.K * Q).norm(), 1e-14 * fe.K.whole().norm() * Q.norm());
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen{Matrix(fe.K.whole())};
  const Vector values = eigen.eigenvalues() / eigen.eigenvalues().maxCoeff();
  EXPECT_LE(values.head<6>().cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_GE(values[6], 1e-3);  // hourglass modes would be at 1e-16
}

TEST_P(Solids, InertiaIntegralsMatchQuadrature) {
  const Structure s = distorted_block(GetParam());
  const FeModel fe = assemble(s);
  const auto n = static_cast<Eigen::Index>(fe.nodes.size());
  double mass = 0;
  Vector3d first = Vector3d::Zero();
  Matrix Ms = Matrix::Zero(n, n);
  Matrix3d second = Matrix3d::Zero();
  Matrix c = Matrix::Zero(fe.dofs.num_dofs, 9);
  for (int e = 0; e < s.solids.num_elements(); ++e) {
    const auto nodes = s.solids.nodes(e);
    const NodeVectors x = s.solids.positions(s.nodes, e);
    // A rule of higher degree than that of the element.
    for (const QuadraturePoint& at : test::fine_rule(GetParam().kind, 7)) {
      const SolidPoint p = solid_point(GetParam().kind, x, at.natural);
      const double dm = test::steel().rho * p.volume * at.weight;
      const Vector3d s0 = x * p.N - fe.shape.com;
      mass += dm;
      first += dm * s0;
      second += dm * s0 * s0.transpose();
      for (int i = 0; i < p.N.size(); ++i) {
        const int I = nodes[static_cast<std::size_t>(i)];
        for (int j = 0; j < p.N.size(); ++j) {
          Ms(I, nodes[static_cast<std::size_t>(j)]) += dm * p.N[i] * p.N[j];
        }
        for (int a = 0; a < 3; ++a) {
          for (int b = 0; b < 3; ++b) c(3 * I + b, 3 * a + b) += dm * s0[a] * p.N[i];
        }
      }
    }
  }
  // All integrands are polynomials that both rules integrate exactly: rounding of 10⁴ terms.
  EXPECT_NEAR(fe.shape.mass, mass, 1e-13 * mass);
  EXPECT_LE(first.norm(), 1e-13 * mass);
  EXPECT_LE((Matrix(*fe.shape.nodal.Ms) - Ms).norm(), 1e-13 * Ms.norm());
  EXPECT_LE((fe.shape.C0 - second).norm(), 1e-13 * second.norm());
  EXPECT_LE((fe.shape.c - c).norm(), 1e-13 * c.norm());
  for (std::size_t k = 0; k < 6; ++k) EXPECT_EQ(fe.shape.W[k].nonZeros(), 0);
  Matrix M = Matrix::Zero(3 * n, 3 * n);
  for (int a = 0; a < 3; ++a) M(Eigen::seqN(a, n, 3), Eigen::seqN(a, n, 3)) = Ms;
  EXPECT_LE((Matrix(fe.M.whole()) - M).norm(), 1e-13 * M.norm());
}

TEST_P(Solids, RefuseElementsInsideOut) {
  Structure s = distorted_block(GetParam());
  for (Node& node : s.nodes) node.position.z() = -node.position.z();
  const std::string kind = choice_names(SolidKind())[static_cast<std::size_t>(GetParam().kind)];
  EXPECT_THAT([&] { assemble(s); }, ThrowsMessage<ModelError>(AllOf(
                                        HasSubstr("solid element 1 (" + kind + ")"),
                                        HasSubstr("Jacobian"), HasSubstr("counter-clockwise"))));
  Structure flat = distorted_block(GetParam());
  for (Node& node : flat.nodes) node.position.z() = 0;
  EXPECT_THAT([&] { assemble(flat); }, ThrowsMessage<ModelError>(HasSubstr("inverted or flat")));
}

// A corner of the unit cube moved along the diagonal to (t, t, t): the Jacobian is
// 1 + (t − 1)(XY + YZ + ZX), 3t − 2 in that corner, and the volume 1 + ¾ (t − 1).
TEST(SolidCorners, MayBeBentAsLongAsTheIntegralsAreSound) {
  const auto cube = [](double t) {
    Structure s;
    std::vector<int> nodes;
    for (const Vector3d& place : std::vector<Vector3d>{{0, 0, 0},
                                                       {1, 0, 0},
                                                       {1, 1, 0},
                                                       {0, 1, 0},
                                                       {0, 0, 1},
                                                       {1, 0, 1},
                                                       {t, t, t},
                                                       {0, 1, 1}}) {
      nodes.push_back(add_node(s, "", place));
    }
    const int steel = s.solids.add_material(test::steel());
    const int element =
        s.solids.add(SolidForm{SolidKind::hex8, SolidIntegration::full}, nodes, steel);
    s.solids.set_number(element, 4711);
    return s;
  };
  const Structure bent = cube(0.6);
  const NodeVectors x = bent.solids.positions(bent.nodes, 0);
  EXPECT_NEAR(solid_least_node_volume(SolidKind::hex8, x), (3 * 0.6 - 2) / 8, 1e-15);
  const FeModel fe = assemble(bent);
  EXPECT_NEAR(fe.shape.mass, 0.7 * test::steel().rho, 1e-12 * test::steel().rho);
  const Eigen::SelfAdjointEigenSolver<Matrix> stiffness{Matrix(fe.K.whole())},
      mass{Matrix(fe.M.whole())};
  EXPECT_GT(mass.eigenvalues()[0], 0);
  EXPECT_GT(stiffness.eigenvalues()[6], 1e-3 * stiffness.eigenvalues()[23]);
  EXPECT_LE(std::abs(stiffness.eigenvalues()[0]), 1e-13 * stiffness.eigenvalues()[23]);
  // At t = 0.3 an integration point of the stiffness has 1 − 0.7 · 1.866 = −0.306.
  EXPECT_THAT([&] { assemble(cube(0.3)); },
              ThrowsMessage<ModelError>(
                  AllOf(HasSubstr("solid element 4711 (hex8)"), HasSubstr("-0.0383 m³"))));
}

// The node on the edge 0–1 moved along it to the place 0.5 − d: ∂x/∂ξ on the edge is
// 1 − 4 d (1 − 2 ξ), negative at corner 0 from d = ¼ on.
TEST(SolidCorners, OfTetrahedraMayTakeFourPoints) {
  const auto bent = [](double d) {
    Structure s;
    std::vector<int> nodes;
    const std::vector<Vector3d> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (const Vector3d& corner : corners) nodes.push_back(add_node(s, "", corner));
    for (const auto& [a, b] : solid_topology(SolidKind::tet10).edges) {
      Vector3d middle =
          0.5 * (corners[static_cast<std::size_t>(a)] + corners[static_cast<std::size_t>(b)]);
      if (nodes.size() == 4) middle.x() -= d;
      nodes.push_back(add_node(s, "", middle));
    }
    s.solids.add(SolidForm{SolidKind::tet10, SolidIntegration::full}, nodes,
                 s.solids.add_material(test::steel()));
    return s;
  };
  // At (ξ, η, ζ) the determinant is 1 − 4 d (1 − 2 ξ − η − ζ): 1 − 4 d · 0.64 next to corner 0
  // among fourteen points, 1 − 4 d · 0.447 among four.
  for (const double d : {0.2, 0.4}) {
    const FeModel fe = assemble(bent(d));
    const Eigen::SelfAdjointEigenSolver<Matrix> stiffness{Matrix(fe.K.whole())};
    EXPECT_LE(std::abs(stiffness.eigenvalues()[0]), 1e-12 * stiffness.eigenvalues()[29]) << d;
    EXPECT_GT(stiffness.eigenvalues()[6], 1e-5 * stiffness.eigenvalues()[29]) << d;
    // Uniform strain has the energy of the volume, which is ∫ 1 − 4 d (1 − 2 ξ − η − ζ) = 1/6.
    const Vector stretch = test::nodal_values(fe, [](const Vector3d& x) { return 1e-3 * x; });
    const double E = test::steel().E, nu = test::steel().nu;
    const double energy = 0.5 * 3e-6 * E / (1 - 2 * nu) / 6;
    EXPECT_NEAR(0.5 * stretch.dot(fe.K * stretch), energy, 1e-12 * energy) << d;
  }
  EXPECT_THAT([&] { assemble(bent(0.45)); },
              ThrowsMessage<ModelError>(HasSubstr("where it is integrated")));
}

TEST_P(Solids, KeepTheirMatricesInParts) {
  const Structure s = distorted_block(GetParam());
  std::vector<int> numbers(s.nodes.size()), elements;
  for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = static_cast<int>(k);
  for (int e = s.solids.num_elements(); e-- > 0;) elements.push_back(e);
  Structure again = s;
  again.solids = s.solids.subset(elements, numbers);
  const FeModel one = assemble(s), two = assemble(again);
  EXPECT_LE(Matrix(one.K.whole() - two.K.whole()).norm(), 1e-13 * one.K.whole().norm());
  EXPECT_LE(Matrix(one.M.whole() - two.M.whole()).norm(), 1e-13 * one.M.whole().norm());
}

INSTANTIATE_TEST_SUITE_P(All, Solids, testing::ValuesIn(test::all_forms()),
                         [](const auto& form) { return test::form_name(form.param); });

TEST(SolidBlock, RefusesWrongNodesAndModes) {
  SolidBlock block;
  const std::vector<int> nodes = {0, 1, 2, 3, 4};
  EXPECT_THAT(
      [&] { block.add(SolidForm::usual(SolidKind::tet4), nodes, 0); },
      ThrowsMessage<ModelError>(HasSubstr("solid element 1 (tet4) has 5 nodes; it needs 4")));
  const std::vector<int> ten(10, 0);
  EXPECT_THAT(
      [&] {
        block.add({SolidKind::tet10, SolidIntegration::incompatible_modes}, ten, 0);
      },
      ThrowsMessage<ModelError>(HasSubstr("only hex8 has incompatible modes")));
}

TEST(SolidBlock, RefusesCollapsedElements) {
  Structure s;
  add_box(s, {{0, 0, 0}, {1, 1, 1}, {1, 1, 1}}, test::steel());
  std::vector<int> nodes(s.solids.nodes(0).begin(), s.solids.nodes(0).end());
  nodes[3] = nodes[2];
  nodes[7] = nodes[6];
  s.solids.add(SolidForm::usual(SolidKind::hex8), nodes, 0);
  EXPECT_THAT([&] { assemble(s); }, ThrowsMessage<ModelError>(AllOf(
                                        HasSubstr("solid element 2 (hex8)"),
                                        HasSubstr("appears in it twice"), HasSubstr("wedge6"))));
}

TEST(SolidBlock, HoldsSeveralKinds) {
  Structure s;
  const Box left{{0, 0, 0}, {1, 1, 1}, {1, 1, 1}};
  add_box(s, left, test::steel(), SolidForm::usual(SolidKind::hex20));
  // A tetrahedron of four nodes on three corners of the face x1.
  const int tip = add_node(s, "tip", {2, 0.3, 0.3});
  const auto corners = face_nodes(s.solids, find_face_set(s, "x1")->faces[0]);
  const std::vector<int> nodes = {corners[0], corners[1], corners[2], tip};
  s.solids.add(SolidForm::usual(SolidKind::tet4), nodes, s.solids.add_material(test::steel()));
  const FeModel fe = assemble(s);
  EXPECT_NEAR(fe.shape.mass, test::steel().rho * (1.0 + 1.0 / 6.0), 1e-9);
  const Matrix Q = test::rigid_motions(fe);
  const Matrix S = Q.transpose() * (fe.M * Q);
  const Matrix3d turning = S.bottomRightCorner<3, 3>();
  EXPECT_LE((turning - fe.shape.J0).norm(), 1e-13 * fe.shape.J0.norm());
  EXPECT_EQ(SolidRecovery(fe).num_elements(), 2);
}

TEST(SolidBlock, RefusesMaterialsThatNoSolidHas) {
  Structure s;
  Material rubber = Material::isotropic(1e6, 0.5, 1000);
  add_box(s, {{0, 0, 0}, {1, 1, 1}, {1, 1, 1}}, rubber);
  EXPECT_THAT([&] { assemble(s); }, ThrowsMessage<ModelError>(HasSubstr("nu = 0.5")));
  Structure t;
  rubber = Material::isotropic(1e6, 0.3, 1000);
  rubber.G = 1e6;
  add_box(t, {{0, 0, 0}, {1, 1, 1}, {1, 1, 1}}, rubber);
  EXPECT_THAT([&] { assemble(t); }, ThrowsMessage<ModelError>(HasSubstr("leave `G` out")));
  Structure u;
  rubber = Material::isotropic(1e6, 0.3, -1000);
  add_box(u, {{0, 0, 0}, {1, 1, 1}, {1, 1, 1}}, rubber);
  EXPECT_THAT([&] { assemble(u); }, ThrowsMessage<ModelError>(HasSubstr("rho = -1000")));
}

TEST(SolidBlock, KeepsAllTranslationsInPlanarModels) {
  const FeModel fe =
      assemble(distorted_block(SolidForm::usual(SolidKind::hex8)), spatial::Plane::xy);
  EXPECT_EQ(fe.dofs.num_dofs, 81);
}

TEST(SolidBlock, MixesWithOtherElements) {
  Structure s;
  const int first = add_box(s, {{0, 0, 0}, {1, 1, 1}, {1, 1, 1}}, test::steel());
  const int tip = add_node(s, "tip", {0, 0, 2});
  for (const int corner : {4, 5, 6})
    s.bars.add(first + corner, tip, test::steel(), Section::circle(0.01));
  s.masses.add(tip, 3.0);
  const FeModel fe = assemble(s);
  const Matrix Q = test::rigid_motions(fe);
  const Matrix S = Q.transpose() * (fe.M * Q);
  EXPECT_NEAR(S(0, 0), fe.shape.mass, 1e-13 * fe.shape.mass);
  const Matrix3d turning = S.bottomRightCorner<3, 3>();
  EXPECT_LE((turning - fe.shape.J0).norm(), 1e-13 * fe.shape.J0.norm());
}

}  // namespace
}  // namespace buckens::fem
