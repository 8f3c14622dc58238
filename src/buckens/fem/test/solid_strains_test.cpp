// SPDX-License-Identifier: Apache-2.0
#include <numeric>

#include <gtest/gtest.h>

#include "buckens/fem/assembly/assemble.h"
#include "buckens/fem/solid/recovery.h"
#include "buckens/fem/solid/strains.h"
#include "buckens/fem/test/solid_fixture.h"

namespace buckens::fem {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

std::vector<int> all_of(std::size_t count) {
  std::vector<int> out(count);
  std::iota(out.begin(), out.end(), 0);
  return out;
}

struct Evaluated {
  FeModel fe;
  SolidStrains strains;
  TensorColumns at_places, at_elements;

  explicit Evaluated(const Structure& structure)
      : fe(assemble(structure, std::nullopt)),
        strains(fe, all_of(fe.nodes.size()), all_of(static_cast<std::size_t>(num_solids(fe)))) {}

  template <class Field>
  void set(Field&& field) {
    strains.evaluate(test::nodal_values(fe, field), at_places, at_elements);
  }
};

class SolidStrainsOfForm : public testing::TestWithParam<SolidForm> {};

TEST_P(SolidStrainsOfForm, UniformStrainComesOutEverywhere) {
  Evaluated mesh(test::distorted_block(GetParam()));
  Matrix3d H;
  H << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  mesh.set([&](const Vector3d& x) { return Vector3d(1e-3 * H * x); });
  Eigen::Matrix<double, 6, 1> expected;
  expected << 1, 5, 9, 6, 14, 10;
  expected *= 1e-3;
  // Isoparametric elements represent linear fields exactly; rounding of gradients.
  for (Eigen::Index p = 0; p < mesh.at_places.cols(); ++p) {
    EXPECT_LT((mesh.at_places.col(p) - expected).norm(), 1e-14);
  }
  for (Eigen::Index e = 0; e < mesh.at_elements.cols(); ++e) {
    EXPECT_LT((mesh.at_elements.col(e) - expected).norm(), 1e-14);
  }
}

TEST_P(SolidStrainsOfForm, CentresAgreeWithTheStressesOfEveryRun) {
  Evaluated mesh(test::distorted_block(GetParam()));
  const auto field = [](const Vector3d& x) {
    return Vector3d(1e-3 * x.x() * x.y(), 2e-3 * x.z() * x.z(), -1e-3 * x.x() * x.x());
  };
  mesh.set(field);
  TensorColumns node_stress, stress;
  mesh.strains.stresses(mesh.at_places, mesh.at_elements, node_stress, stress);
  const linalg::Matrix known = SolidRecovery(mesh.fe).stresses(test::nodal_values(mesh.fe, field));
  // Two orders of summation.
  EXPECT_LT((stress - known.topRows<6>()).norm(), 1e-12 * known.topRows<6>().norm());
  EXPECT_EQ(node_stress.cols(), static_cast<Eigen::Index>(mesh.fe.nodes.size()));
}

INSTANTIATE_TEST_SUITE_P(Forms, SolidStrainsOfForm, testing::ValuesIn(test::all_forms()),
                         [](const auto& form) { return test::form_name(form.param); });

/// A bar of one element across, bent: u = (x z, 0, −x²/2) has ε_xx = z and no other strain where
/// ν = 0.
TEST(SolidStrains, OneHex8AcrossShowsBendingAtItsSurface) {
  Material material = test::steel();
  material.nu = 0;
  material.G = material.E / 2;
  Structure s;
  add_box(s, {{0, 0, -0.5}, {4, 1, 1}, {4, 1, 1}}, material, SolidForm::usual(SolidKind::hex8));
  Evaluated mesh(s);
  mesh.set([](const Vector3d& x) { return Vector3d(x.x() * x.z(), 0, -0.5 * x.x() * x.x()); });
  for (std::size_t p = 0; p < mesh.strains.places().size(); ++p) {
    const Vector3d& x =
        mesh.fe.nodes[static_cast<std::size_t>(mesh.strains.places()[p].node)].position;
    const auto strain = mesh.at_places.col(static_cast<Eigen::Index>(p));
    // The inner modes remove the spurious shear and leave the bending strain of the nodes exactly.
    EXPECT_NEAR(strain[0], x.z(), 1e-13);
    EXPECT_NEAR(strain[5], 0.0, 1e-13);
  }
}

TEST(SolidStrains, AveragesDoNotCrossMaterials) {
  Structure s;
  Material soft = test::steel();
  soft.E *= 0.25;
  soft.G *= 0.25;
  for (const double x : {0.0, 1.0, 2.0, -1.0}) {
    for (int k = 0; k < 4; ++k)
      add_node(s, "", {x, k == 1 || k == 2 ? 1.0 : 0.0, k < 2 ? 0.0 : 1.0});
  }
  const int hard = s.solids.add_material(test::steel());
  const int yielding = s.solids.add_material(soft);
  const int twin = s.solids.add_material(test::steel());  // the same under another number
  s.solids.add({0, 4, 5, 1, 3, 7, 6, 2}, hard);
  s.solids.add({4, 8, 9, 5, 7, 11, 10, 6}, yielding);
  s.solids.add({12, 0, 1, 13, 15, 3, 2, 14}, twin);
  Evaluated mesh(s);
  ASSERT_EQ(mesh.strains.elasticities().size(), 2U);
  EXPECT_EQ(mesh.strains.places().size(), 20U);  // the four nodes between occur twice
  // Stretched to ε in the hard element and 4 ε in the soft one: equal stress on both sides.
  mesh.set([](const Vector3d& x) {
    return Vector3d(x.x() < 1 ? 1e-3 * x.x() : 1e-3 + 4e-3 * (x.x() - 1), 0, 0);
  });
  TensorColumns stress, at_elements;
  mesh.strains.stresses(mesh.at_places, mesh.at_elements, stress, at_elements);
  const double expected = at_elements(0, 0);
  EXPECT_GT(expected, 0);
  for (Eigen::Index p = 0; p < stress.cols(); ++p) {
    EXPECT_NEAR(stress(0, p), expected, 1e-12 * expected);
  }
  EXPECT_NE(mesh.strains.place_of(4, 0), mesh.strains.place_of(4, 1));
  EXPECT_EQ(mesh.strains.place_of(0, 1), -1);
  EXPECT_EQ(mesh.strains.place_of(0, 0), mesh.strains.place_of(0, 2)) << "the same steel";
}

TEST(SolidStrains, OnlyWantedPlacesAreThereAndDoNotDependOnTheOthers) {
  const Structure s = test::distorted_block(SolidForm::usual(SolidKind::hex8));
  Evaluated all(s);
  const auto field = [](const Vector3d& x) {
    return Vector3d(x.x() * x.y(), x.z() * x.x(), x.y() * x.y());
  };
  all.set(field);
  const FeModel fe = assemble(s, std::nullopt);
  SolidStrains some(fe, {3, 17}, {5});
  TensorColumns at_places, at_elements;
  some.evaluate(test::nodal_values(fe, field), at_places, at_elements);
  ASSERT_EQ(at_places.cols(), 2);
  ASSERT_EQ(at_elements.cols(), 1);
  EXPECT_EQ(at_places.col(0), all.at_places.col(3));
  EXPECT_EQ(at_places.col(1), all.at_places.col(17));
  EXPECT_EQ(at_elements.col(0), all.at_elements.col(5));
}

TEST(SolidStrains, PrincipalStressesFall) {
  Eigen::Matrix<double, 6, 1> s;
  s << 1, 1, 5, 2, 0, 0;  // in the x-y plane 1 ± 2
  const Vector3d p = principal_stresses(s);
  EXPECT_NEAR(p[0], 5, 1e-14);
  EXPECT_NEAR(p[1], 3, 1e-14);
  EXPECT_NEAR(p[2], -1, 1e-14);
}

/// Largest error of the strains of a smooth field at all nodes and at all centres.
std::pair<double, double> errors(const SolidForm& form, int divisions) {
  Structure s;
  add_box(s, {{0, 0, 0}, {1, 1, 1}, {divisions, divisions, divisions}}, test::steel(), form);
  Evaluated mesh(s);
  const auto strain = [](const Vector3d& x) {
    Eigen::Matrix<double, 6, 1> out;
    out << std::cos(x.x()) * std::cos(x.y()), 0, -std::sin(x.z()),
        -std::sin(x.x()) * std::sin(x.y()), 0, 0;
    return out;
  };
  mesh.set([](const Vector3d& x) {
    return Vector3d(std::sin(x.x()) * std::cos(x.y()), 0, std::cos(x.z()));
  });
  double at_nodes = 0, at_centres = 0;
  for (Eigen::Index p = 0; p < mesh.at_places.cols(); ++p) {
    const auto node = static_cast<std::size_t>(p);
    at_nodes = std::max(
        at_nodes,
        (mesh.at_places.col(p) - strain(mesh.fe.nodes[node].position)).lpNorm<Eigen::Infinity>());
  }
  for (int e = 0; e < mesh.strains.num_elements(); ++e) {
    Vector3d centre = Vector3d::Zero();
    const auto nodes = s.solids.nodes(e);
    const auto corners = static_cast<std::size_t>(solid_topology(form.kind).num_corners);
    for (std::size_t k = 0; k < corners; ++k) {
      centre += s.nodes[static_cast<std::size_t>(nodes[k])].position / static_cast<double>(corners);
    }
    at_centres =
        std::max(at_centres, (mesh.at_elements.col(e) - strain(centre)).lpNorm<Eigen::Infinity>());
  }
  return {at_nodes, at_centres};
}

class Orders : public testing::TestWithParam<SolidForm> {};

/// With exact nodal values the error falls with the square of the size at the centres of hex8 and
/// for quadratic elements everywhere; others are of first order.
TEST_P(Orders, AreThoseOfTheTheory) {
  const auto [coarse_nodes, coarse_centres] = errors(GetParam(), 4);
  const auto [fine_nodes, fine_centres] = errors(GetParam(), 8);
  const bool is_linear = !test::is_quadratic(GetParam());
  // Triangles and pyramids with straight sides have no point of higher accuracy.
  const SolidKind kind = GetParam().kind;
  const bool is_first_order =
      kind == SolidKind::tet4 || kind == SolidKind::wedge6 || kind == SolidKind::pyramid5;
  // Half an order below the theoretical factors 2 and 4: the meshes are coarse.
  EXPECT_GT(coarse_nodes / fine_nodes, is_linear ? 1.4 : 2.8);
  EXPECT_GT(coarse_centres / fine_centres, is_first_order ? 1.4 : 2.8);
}

INSTANTIATE_TEST_SUITE_P(Forms, Orders, testing::ValuesIn(test::all_forms()),
                         [](const auto& form) { return test::form_name(form.param); });

}  // namespace
}  // namespace buckens::fem
