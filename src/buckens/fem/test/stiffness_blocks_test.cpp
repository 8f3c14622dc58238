// SPDX-License-Identifier: Apache-2.0
// Which stiffness matrices are stored as blocks of nodes: those that are symmetric to the last bit
// and whose nodes have three variables each.
#include <gtest/gtest.h>

#include "buckens/fem/assembly/assemble.h"
#include "buckens/fem/assembly/stiffness_assembly.h"
#include "buckens/fem/test/solid_fixture.h"
#include "buckens/linalg/node_blocks.h"
#include "buckens/linalg/same_bits.h"

namespace buckens::fem::test {
namespace {

using linalg::SparseMatrix;

Material damped_block_steel() {
  Material material = steel();
  material.damping_stiffness = 1e-4;
  return material;
}

double share_of_sparse(const linalg::SymmetricMatrix& K) {
  return K.blocks()->bytes() / (12.0 * static_cast<double>(K.nonZeros()));
}

class StiffnessBlocks : public testing::TestWithParam<SolidForm> {};

TEST_P(StiffnessBlocks, OfSolidsHaveTheAssembledEntries) {
  const FeModel fe = assemble(distorted_block(GetParam(), damped_block_steel()));
  const StiffnessMatrices expected = assemble_stiffness(fe.blocks, {fe.nodes, fe.dofs});
  ASSERT_NE(fe.K.blocks(), nullptr);
  EXPECT_TRUE(linalg::have_same_bits(fe.K.copied(), expected.K));
  EXPECT_LT(share_of_sparse(fe.K), 0.45);
  ASSERT_NE(fe.K_damping.blocks(), nullptr);
  EXPECT_TRUE(linalg::have_same_bits(fe.K_damping.copied(), expected.K_damping));
}

TEST_P(StiffnessBlocks, OfRegularMeshesKeepTheirPattern) {
  Structure s;
  add_box(s, {{0, 0, 0}, {0.4, 0.4, 0.4}, {4, 4, 4}}, steel(), GetParam());
  const FeModel fe = assemble(s);
  const StiffnessMatrices expected = assemble_stiffness(fe.blocks, {fe.nodes, fe.dofs});
  EXPECT_EQ(fe.K.nonZeros(), expected.K.nonZeros());
  EXPECT_TRUE(linalg::have_same_bits(fe.K.copied(), expected.K));
  ASSERT_NE(fe.K.blocks(), nullptr);
  EXPECT_LT(share_of_sparse(fe.K), 0.667);
}

INSTANTIATE_TEST_SUITE_P(Forms, StiffnessBlocks, testing::ValuesIn(all_forms()),
                         [](const auto& form) { return form_name(form.param); });

TEST(StiffnessBlocksOfOthers, BeamsBesideSolidsAreMetToo) {
  Structure s = distorted_block(SolidForm::usual(SolidKind::hex8));
  const int tip = add_node(s, "tip", {0.9, 0.1, 0.3});
  const int foot = add_node(s, "foot", {0.5, 0.1, 0.3});
  add_beam(s, foot, tip, 3, beam_properties(BeamTheory::timoshenko, true));
  s.bars.add(0, foot, steel(), Section::circle(0.01));
  const FeModel fe = assemble(s);
  const StiffnessMatrices expected = assemble_stiffness(fe.blocks, {fe.nodes, fe.dofs});
  EXPECT_TRUE(linalg::have_same_bits(fe.K.copied(), expected.K));
}

}  // namespace
}  // namespace buckens::fem::test
