// SPDX-License-Identifier: Apache-2.0
// In one process; over several: tests/test_mpi.py.
#include "buckens/fem/assembly/solid_inertia.h"

#include <gtest/gtest.h>

#include "buckens/fem/assembly/assemble.h"
#include "buckens/fem/assembly/made_columns.h"
#include "buckens/fem/test/solid_fixture.h"

namespace buckens::fem::test {
namespace {

using linalg::SparseMatrix;

const std::shared_ptr<const ElementBlock>& solids_of(const FeModel& fe) {
  return *std::find_if(fe.blocks.begin(), fe.blocks.end(),
                       [](const auto& block) { return block->is_solid(); });
}

/// Ms as processes make it, which have so many runs of nodes, and both triangles of it.
SparseMatrix made_in_runs(const FeModel& fe, int runs) {
  const auto n = static_cast<int>(fe.nodes.size());
  const DofMap numbers = one_per_node(fe.nodes.size());
  std::vector<linalg::Triplet> entries;
  for (int k = 0; k < runs; ++k) {
    const int first = n * k / runs;
    const int end = n * (k + 1) / runs;
    const auto description = description_of_columns(MeshMatrix::scalar_mass, {solids_of(fe)},
                                                    {fe.nodes, numbers}, first, end);
    const SparseMatrix some = made_columns(description, first, end);
    for (int column = 0; column < some.cols(); ++column) {
      for (SparseMatrix::InnerIterator it(some, column); it; ++it) {
        const int whole = first + column;
        entries.emplace_back(it.row(), whole, it.value());
        if (it.row() != whole) entries.emplace_back(whole, it.row(), it.value());
      }
    }
  }
  SparseMatrix out(n, n);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

Structure moved(Structure s, const Eigen::Vector3d& by) {
  for (Node& node : s.nodes) node.position += by;
  return s;
}

/// The integrals as products with Ms, of which processes have columns, and those over elements.
void expect_integrals_of_elements(const Structure& s) {
  const FeModel fe = assemble(s);
  for (const int runs : {1, 2, 3}) {
    const SparseMatrix Ms = made_in_runs(fe, runs);
    ASSERT_EQ(Ms.nonZeros(), fe.shape.nodal.Ms->nonZeros());
    ASSERT_EQ((Ms - *fe.shape.nodal.Ms).norm(), 0.0) << runs;
    const SolidInertia solids(Ms, fe.nodes);
    // Sums of thousands of shares in another order.
    constexpr double kRounding = 1e-12;
    InertiaSum sum;
    sum.c = linalg::Matrix::Zero(fe.dofs.num_dofs, 9);
    solids.add_moments(fe.dofs, fe.shape.com, sum);
    // The distance from the mass centre has the rounding of positions.
    const double place = 1 + fe.shape.com.norm();
    EXPECT_LT((sum.c - fe.shape.c).norm(), kRounding * place * fe.shape.c.norm());
    EXPECT_LT((sum.C0 - fe.shape.C0).norm(), kRounding * place * fe.shape.C0.norm());
  }
}

class SolidInertiaTest : public ::testing::TestWithParam<SolidForm> {};

TEST_P(SolidInertiaTest, HasTheIntegralsOverItsElements) {
  expect_integrals_of_elements(distorted_block(GetParam(), steel()));
}

TEST_P(SolidInertiaTest, HasThemFarFromTheOrigin) {
  expect_integrals_of_elements(moved(distorted_block(GetParam(), steel()), {300, -200, 100}));
}

INSTANTIATE_TEST_SUITE_P(AllForms, SolidInertiaTest, ::testing::ValuesIn(all_forms()),
                         [](const auto& form) { return form_name(form.param); });

TEST(SolidInertia, LeavesOutNodesOfOtherElements) {
  Structure s = distorted_block(SolidForm::usual(SolidKind::hex8), steel());
  const FeModel without = assemble(s);
  s.masses.add(0, 3.0);
  const FeModel fe = assemble(s);
  InertiaSum sum;
  sum.c = linalg::Matrix::Zero(fe.dofs.num_dofs, 9);
  SolidInertia(made_in_runs(fe, 2), fe.nodes).add_moments(fe.dofs, without.shape.com, sum);
  EXPECT_LT((sum.C0 - without.shape.C0).norm(), 1e-12 * without.shape.C0.norm());
}

}  // namespace
}  // namespace buckens::fem::test
