// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "buckens/analysis/simulation/simulate.h"
#include "buckens/model/test/described.h"
#include "buckens/results/table.h"

namespace buckens::analysis {
namespace {

/// A soft block on a ball joint, damped by mass and stiffness.
model::test::Described swinging_block(body::CouplingLevel level) {
  model::test::Described m;
  m.d.gravity = {0, -9.81, 0};
  body::BodySpec& block = m.block("block", {0.3, 0.1, 0.1}, {6, 2, 2});
  block.coupling.level = level;
  fem::DampingSpec damping;
  damping.mass = 0.2;
  damping.stiffness = 1e-6;
  block.damping = damping;
  m.joint<joints::SphericalSpec>("pin", "ground", "block/corner_000");
  m.d.simulation.emplace();
  m.d.simulation->duration = 0.02;
  m.d.simulation->step = 1e-3;
  return m;
}

TEST(MassOfSolids, RunsNeedNoneOfItsEntries) {
  for (const auto level : {body::CouplingLevel::full, body::CouplingLevel::none}) {
    const auto built = swinging_block(level).build();
    results::Table table;
    EXPECT_TRUE(simulate(*built, table).finished);
    const linalg::SymmetricMatrix& M = built->model.bodies[0].flexible->fe.M;
    EXPECT_NE(M.nodes(), nullptr);
    EXPECT_EQ(M.nodes(), built->model.bodies[0].flexible->fe.shape.nodal.Ms.get());
    EXPECT_FALSE(M.is_formed());
  }
}

}  // namespace
}  // namespace buckens::analysis
