// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "buckens/analysis/initial/velocity.h"
#include "buckens/dynamics/energy.h"
#include "buckens/model/test/described.h"
#include "buckens/spatial/rotation.h"

namespace buckens::analysis {
namespace {

using Eigen::Vector3d;
using model::test::Described;

/// Free steel beam of 1 m, turned in space, with the given frames and initial motion.
Described moving_beam(const body::FrameDivision& frames, bool with_field) {
  Described m;
  auto& rod = m.beam("rod", Vector3d(0.2, 0, 0), Vector3d(1.2, 0, 0), 6);
  rod.frames = frames;
  rod.at.position = {1, 2, 3};
  rod.at.orientation.emplace().euler = Vector3d(0.3, -0.7, 1.1);
  model::InitialBodySpec initial;
  initial.name = "rod";
  initial.velocity = {1, -2, 0.5};
  initial.angular_velocity = {0.1, 2.0, -3.0};
  if (with_field) {
    auto& field = initial.nodal_velocity.emplace();
    field.y = {base::Expression("3*x^2 + x", {"x", "y", "z"}, {}, {}), 1.0, true};
    field.rz = {base::Expression("6*x + 1", {"x", "y", "z"}, {}, {}), 1.0, true};
  }
  m.d.initial.bodies.push_back(initial);
  return m;
}

model::State started(const model::BuiltModel& built) {
  model::State state = model::placed_state(built.model);
  set_initial_velocities(built, state);
  return state;
}

/// Velocity of a node of the whole mesh in the world.
Vector3d node_velocity(const model::Model& model, const model::State& state, std::size_t node) {
  const model::WholeBody& whole = model.wholes[0];
  const model::MeshCopy copy =
      whole.is_divided() ? whole.nodes[node] : model::MeshCopy{0, static_cast<int>(node)};
  const auto b = static_cast<std::size_t>(copy.body);
  const body::Body& body = model.bodies[b];
  const model::BodyState& s = state.bodies[b];
  const auto n = static_cast<std::size_t>(copy.index);
  const fem::FeModel& fe = body.flexible->fe;
  Vector3d relative;
  for (int k = 0; k < 3; ++k)
    relative[k] = s.d_dot[fe.dofs.node_dofs[n][static_cast<std::size_t>(k)]];
  return s.frame.v + s.frame.X_WB.q * (s.frame.w.cross(fe.nodes[n].position - body.com) + relative);
}

TEST(InitialVelocity, IsThatOfTheWholeBodyWhateverItsFrames) {
  for (const bool with_field : {false, true}) {
    const auto one = moving_beam(1, with_field).build();
    const auto three = moving_beam(3, with_field).build();
    const model::State reference = started(*one);
    const model::State state = started(*three);
    for (std::size_t n = 0; n < 7; ++n) {
      const Vector3d expected = node_velocity(one->model, reference, n);
      EXPECT_LT((node_velocity(three->model, state, n) - expected).norm(), 1e-12) << n;
    }
    const dynamics::Momentum a = dynamics::momentum(one->model, reference);
    const dynamics::Momentum b = dynamics::momentum(three->model, state);
    EXPECT_LT((a.linear - b.linear).norm(), 1e-12 * a.linear.norm());
    EXPECT_LT((a.angular - b.angular).norm(), 1e-12 * a.angular.norm());
    EXPECT_NEAR(dynamics::energy(three->model, state).kinetic,
                dynamics::energy(one->model, reference).kinetic,
                1e-12 * dynamics::energy(one->model, reference).kinetic);
    // The field was sieved: the mass centre moves as requested.
    EXPECT_LT((a.linear / one->model.wholes[0].mass - Vector3d(1, -2, 0.5)).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace buckens::analysis
