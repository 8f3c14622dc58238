// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/initial/assembly_moves.h"

#include <gtest/gtest.h>

#include "buckens/model/test/described.h"

namespace buckens::analysis {
namespace {

using Eigen::Vector3d;

// Parts that turn together do so but for rounding, which differs between numbers of processes.
TEST(AssemblyMoves, TellTheFirstOfPartsThatTurnAlike) {
  model::test::Described m;
  m.beam("rod", {0, 0, 0}, {1, 0, 0}, 4).frames = 2;
  const auto built = m.build();
  for (const double more : {-1e-14, 0.0, 1e-14}) {
    model::State state = model::placed_state(built->model);
    ASSERT_EQ(state.bodies.size(), 2U);
    const double angles[] = {0.1, 0.1 + more};
    Vector3d moved[2];
    for (std::size_t b = 0; b < 2; ++b) {
      spatial::Pose& pose = state.bodies[b].frame.X_WB;
      const Eigen::AngleAxisd turn(angles[b], Vector3d::UnitZ());
      moved[b] = turn * pose.p - pose.p;
      pose.p += moved[b];
      pose.q = turn * pose.q;
    }
    const std::vector<AssemblyMove> moves = assembly_moves(built->model, state);
    ASSERT_EQ(moves.size(), 1U);
    EXPECT_GT(moved[1].norm(), 2.0 * moved[0].norm());
    EXPECT_LT((moves[0].translation - moved[0]).norm(), 1e-15) << more;
    EXPECT_NEAR(moves[0].angle, 0.1, 1e-12);
  }
}

}  // namespace
}  // namespace buckens::analysis
