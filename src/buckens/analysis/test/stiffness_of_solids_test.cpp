// SPDX-License-Identifier: Apache-2.0
// Stiffness and damping of solids are stored as blocks of nodes, and runs need nothing else.
#include <gtest/gtest.h>

#include "buckens/analysis/simulation/simulate.h"
#include "buckens/linalg/node_blocks.h"
#include "buckens/model/test/described.h"
#include "buckens/results/table.h"

namespace buckens::analysis {
namespace {

model::test::Described swinging_block(bool is_damped) {
  model::test::Described m;
  m.d.gravity = {0, -9.81, 0};
  body::BodySpec& block = m.block("block", {0.3, 0.1, 0.1}, {6, 2, 2});
  if (is_damped) {
    block.damping.emplace();
    block.damping->mass = 0.2;
    block.damping->stiffness = 1e-6;
  }
  m.joint<joints::SphericalSpec>("pin", "ground", "block/corner_000");
  m.d.simulation.emplace();
  m.d.simulation->duration = 0.02;
  m.d.simulation->step = 1e-3;
  return m;
}

void expect_blocks_alone(const linalg::SymmetricMatrix& A) {
  ASSERT_NE(A.blocks(), nullptr);
  EXPECT_FALSE(A.is_formed());
}

TEST(StiffnessOfSolids, RunsNeedNothingButItsBlocks) {
  for (const bool is_damped : {false, true}) {
    const auto built = swinging_block(is_damped).build();
    const body::FlexiblePart& part = *built->model.bodies[0].flexible;
    results::Table table;
    EXPECT_TRUE(simulate(*built, table).finished);
    expect_blocks_alone(part.fe.K);
    if (is_damped) expect_blocks_alone(part.C);
  }
}

TEST(StiffnessOfSolids, TakesTwoFifthsOfTheMemory) {
  const auto built = swinging_block(false).build();
  const linalg::SymmetricMatrix& K = built->model.bodies[0].flexible->fe.K;
  ASSERT_NE(K.blocks(), nullptr);
  EXPECT_LT(K.blocks()->bytes(), 0.45 * 12.0 * static_cast<double>(K.nonZeros()));
}

TEST(StiffnessOfSolids, ReducedBodiesAreMadeOfItsBlocks) {
  auto m = swinging_block(true);
  m.d.bodies[0].reduction.craig_bampton.emplace();
  m.d.bodies[0].reduction.craig_bampton->modes = 3;
  const auto built = m.build();
  expect_blocks_alone(built->model.bodies[0].flexible->mesh().K);
}

}  // namespace
}  // namespace buckens::analysis
