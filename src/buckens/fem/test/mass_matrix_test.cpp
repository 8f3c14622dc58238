// SPDX-License-Identifier: Apache-2.0
// Which mass matrices are those of nodes.
#include <gtest/gtest.h>

#include "buckens/fem/assembly/assemble.h"
#include "buckens/fem/test/solid_fixture.h"

namespace buckens::fem::test {
namespace {

Structure block() { return distorted_block(SolidForm::usual(SolidKind::hex8)); }

TEST(MassMatrix, OfSolidsAloneReadsThatOfTheNodes) {
  const FeModel fe = assemble(block());
  EXPECT_EQ(fe.M.nodes(), fe.shape.nodal.Ms.get());
}

TEST(MassMatrix, OfOtherElementsTooHasEntriesOfItsOwn) {
  Structure with_mass = block();
  with_mass.masses.add(0, 2.0);
  const FeModel fe = assemble(with_mass);
  EXPECT_EQ(fe.M.nodes(), nullptr);
  const linalg::SparseMatrix solids = assemble(block()).M.whole();
  EXPECT_NEAR(fe.M.diagonal()[0], solids.coeff(0, 0) + 2.0, 1e-13);
}

}  // namespace
}  // namespace buckens::fem::test
