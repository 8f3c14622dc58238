// SPDX-License-Identifier: Apache-2.0
// In one process; over several: tests/test_mpi.py.
#include "buckens/fem/assembly/made_columns.h"

#include <gtest/gtest.h>

#include "buckens/fem/test/solid_fixture.h"

namespace buckens::fem::test {
namespace {

using linalg::SparseMatrix;

/// That columns have the entries of A from the diagonal on, with their bits.
void expect_columns(const SparseMatrix& found, const SparseMatrix& A, int first) {
  ASSERT_EQ(found.rows(), A.rows());
  for (int k = 0; k < found.cols(); ++k) {
    SparseMatrix::InnerIterator it(found, k);
    for (SparseMatrix::InnerIterator whole(A, first + k); whole; ++whole) {
      if (whole.row() < first + k) continue;
      ASSERT_TRUE(it) << k;
      ASSERT_EQ(it.row(), whole.row()) << k;
      ASSERT_EQ(it.value(), whole.value()) << k;
      ++it;
    }
    ASSERT_FALSE(it) << k;
  }
}

void expect_same_matrices(const Structure& s) {
  const FeModel fe = assemble(s);
  const MeshView mesh{fe.nodes, fe.dofs};
  const int n = fe.dofs.num_dofs;
  const std::array<const SparseMatrix*, 3> matrices = {&fe.M.whole(), &fe.K.whole(),
                                                       &fe.K_damping.whole()};
  // Runs that begin and end within a node; one of them is empty.
  const std::array<int, 5> runs = {0, n / 3 + 1, n / 3 + 1, n - 4, n};
  for (const MeshMatrix which : {MeshMatrix::mass, MeshMatrix::stiffness, MeshMatrix::damping}) {
    for (std::size_t k = 0; k + 1 < runs.size(); ++k) {
      const std::vector<std::byte> description =
          description_of_columns(which, s.solids, mesh, runs[k], runs[k + 1]);
      const SparseMatrix found = made_columns(description, runs[k], runs[k + 1]);
      ASSERT_EQ(found.cols(), runs[k + 1] - runs[k]);
      expect_columns(found, *matrices[static_cast<std::size_t>(which)], runs[k]);
    }
  }
}

Material crossed() {
  Material material = steel();
  material.damping_stiffness = 1e-4;
  Orthotropy& of = material.orthotropy.emplace();
  of.E = {140e9, 10e9, 9e9};
  of.nu12 = 0.3;
  of.nu13 = 0.25;
  of.nu23 = 0.4;
  of.G12 = 5e9;
  of.G13 = 4e9;
  of.G23 = 3e9;
  of.axes = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  return material;
}

class MadeColumnsTest : public ::testing::TestWithParam<SolidForm> {};

TEST_P(MadeColumnsTest, HaveTheBitsOfAnAssemblyInOneProcess) {
  expect_same_matrices(distorted_block(GetParam(), crossed()));
}

INSTANTIATE_TEST_SUITE_P(AllForms, MadeColumnsTest, ::testing::ValuesIn(all_forms()),
                         [](const auto& form) { return form_name(form.param); });

TEST(MadeColumnsOfBodyTest, KeepEachElementsMaterial) {
  Structure s;
  add_box(s, {{0, 0, 0}, {0.4, 0.3, 0.2}, {6, 3, 3}}, steel(), SolidForm::usual(SolidKind::hex8));
  SolidBlock mixed;
  Material weightless = steel();
  weightless.rho = 0;
  Material damped = crossed();
  const std::array<int, 3> materials = {mixed.add_material(damped), mixed.add_material(steel()),
                                        mixed.add_material(weightless)};
  for (int e = 0; e < s.solids.num_elements(); ++e) {
    mixed.add(s.solids.form(e), s.solids.nodes(e), materials[static_cast<std::size_t>(e % 3)]);
  }
  s.solids = mixed;
  expect_same_matrices(s);
}

TEST(MadeColumnsOfBodyTest, OfMoreElementsThanOnePiece) {
  Structure s;
  add_box(s, {{0, 0, 0}, {0.4, 0.3, 0.2}, {12, 12, 12}}, crossed(),
          SolidForm::usual(SolidKind::hex8));
  expect_same_matrices(s);
}

TEST(MadeColumnsOfBodyTest, NeedAFewElementsMoreThanTheirShare) {
  Structure s;
  add_box(s, {{0, 0, 0}, {0.4, 0.4, 0.4}, {16, 16, 16}}, steel(),
          SolidForm::usual(SolidKind::hex8));
  const FeModel fe = assemble(s);
  const MeshView mesh{fe.nodes, fe.dofs};
  const int n = fe.dofs.num_dofs;
  const auto bytes = [&](int first, int end) {
    return static_cast<double>(
        description_of_columns(MeshMatrix::stiffness, s.solids, mesh, first, end).size());
  };
  // A layer of nodes more on each side, of seventeen.
  EXPECT_LT(bytes(n / 4, n / 2), (0.25 + 2.5 / 17) * bytes(0, n));
}

}  // namespace
}  // namespace buckens::fem::test
