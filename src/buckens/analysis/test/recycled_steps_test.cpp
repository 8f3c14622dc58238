// SPDX-License-Identifier: Apache-2.0
// Second solves of steps with `full` that earlier ones answer.
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "buckens/dynamics/energy.h"
#include "buckens/fem/mesh/box_mesh.h"
#include "buckens/stepping/test/same_state.h"
#include "buckens/stepping/test/simulate.h"

namespace buckens::stepping {
namespace {

using buckens::test::Mechanism;
using buckens::test::Start;

/// Steel blocks of 1 × 0.1 × 0.1 m side by side, each on a ball joint in the middle of its end,
/// released from the horizontal: they ring in bending at 366 Hz and above.
model::Model released_blocks(const std::array<int, 3>& divisions, int count = 1) {
  Mechanism m;
  m.set_gravity({0, -9.81, 0});
  for (int k = 0; k < count; ++k) {
    fem::Structure structure;
    fem::Box box;
    box.size = {1.0, 0.1, 0.1};
    box.divisions = divisions;
    fem::add_box(structure, box, fem::Material::isotropic(2.1e11, 0.3, 7850));
    const Eigen::Vector3d place(0, 0, 0.5 * k);
    const int body = m.add_flexible(fem::assemble(structure), body::CouplingLevel::full,
                                    {place, Eigen::Quaterniond::Identity()});
    const int middle =
        (divisions[0] + 1) * (divisions[1] / 2 + divisions[2] / 2 * (divisions[1] + 1));
    m.add_joint(joints::JointType::spherical,
                Mechanism::ground(place + Eigen::Vector3d(0, 0.05, 0.05)),
                m.node_marker(body, middle));
  }
  return m.take();
}

StepSettings ringing_steps(int kept_solves) {
  StepSettings settings;
  settings.step = 1e-4;
  settings.kept_solves = kept_solves;
  return settings;
}

struct Outcome {
  model::State end;
  SolveCounts counts;
  double largest_energy_error = 0;  // relative to the kinetic energy at the end
};

Outcome after(const model::Model& model, const StepSettings& settings, int steps) {
  const Start start = buckens::test::consistent_start(model);
  Stepper stepper(model, settings, start.rows_in_use);
  Outcome out;
  out.end = start.state;
  const double before = dynamics::energy(model, start.state).total();
  for (int k = 0; k < steps; ++k) {
    stepper.step(out.end);
    if (k % 50 != 49) continue;
    const double now = dynamics::energy(model, out.end).total();
    out.largest_energy_error = std::max(out.largest_energy_error, std::abs(now - before));
  }
  out.largest_energy_error /= dynamics::energy(model, out.end).kinetic;
  out.counts = stepper.counts(0);
  return out;
}

/// Distances of the tip [m] and of the bearing's force, relative.
std::array<double, 2> distances(const model::Model& model, const Outcome& a, const Outcome& b,
                                std::size_t tip) {
  return {(buckens::test::node_position(model, a.end, 0, tip) -
           buckens::test::node_position(model, b.end, 0, tip))
              .norm(),
          (a.end.lambda - b.end.lambda).norm() / b.end.lambda.norm()};
}

TEST(RecycledSteps, TakeOneSolveEachAfterAReleaseAndTheSameWay) {
  constexpr int kSteps = 500;
  const std::array<int, 3> divisions = {20, 4, 4};
  const auto tip = static_cast<std::size_t>(divisions[0]);
  const model::Model model = released_blocks(divisions);
  const Outcome all = after(model, ringing_steps(0), kSteps);
  const Outcome kept = after(model, ringing_steps(80), kSteps);
  EXPECT_EQ(all.counts.recycled, 0);
  EXPECT_GE(all.counts.solves, 2 * kSteps - 10);
  EXPECT_LE(kept.counts.solves, kSteps + 80);
  EXPECT_GE(kept.counts.solves + kept.counts.recycled, 2 * kSteps - 10);
  EXPECT_LT(kept.largest_energy_error, 1.02 * all.largest_energy_error);
  // What leaving out the second solve changes of the force is the measure for both: for what two
  // solves leave in comparison with iteration, and for what kept ones change.
  StepSettings iterated = ringing_steps(0);
  iterated.iterate_coupling = true;
  iterated.outer_tolerance = 1e-12;
  StepSettings single = ringing_steps(0);
  single.outer_tolerance = 1.0;
  const auto of_two = distances(model, all, after(model, iterated, kSteps), tip);
  const auto of_kept = distances(model, kept, all, tip);
  const auto of_one = distances(model, after(model, single, kSteps), all, tip);
  for (std::size_t k = 0; k < 2; ++k) {
    RecordProperty("kept_" + std::to_string(k), fmt::format("{:.2e}", of_kept[k]));
    RecordProperty("two_" + std::to_string(k), fmt::format("{:.2e}", of_two[k]));
    RecordProperty("one_" + std::to_string(k), fmt::format("{:.2e}", of_one[k]));
  }
  // Of the tip only rounding is seen.
  EXPECT_LT(of_kept[0], 1e-13);
  EXPECT_LT(of_kept[1], 1e-2 * of_one[1]);
  EXPECT_LT(of_two[1], 1e-2 * of_one[1]);
  RecordProperty("solves", std::to_string(kept.counts.solves));
}

/// A free block of steel that turns and rings in bending. About three axes at a time, its loads
/// would span more than pairs are kept for.
struct Turning {
  model::Model model;
  Start start;

  Turning() {
    Mechanism m;
    fem::Structure structure;
    fem::Box box;
    box.size = {1.0, 0.2, 0.1};
    box.divisions = {20, 4, 3};
    fem::add_box(structure, box, fem::Material::isotropic(2.1e11, 0.3, 7850));
    m.add_flexible(fem::assemble(structure), body::CouplingLevel::full, {});
    model = m.take();
    start = buckens::test::consistent_start(model, [&](model::State& state) {
      const body::FlexiblePart& part = *model.bodies[0].flexible;
      state.bodies[0].frame.w = {0, 30, 0};
      linalg::Vector rate = linalg::Vector::Zero(part.num_dofs());
      for (std::size_t node = 0; node < part.fe.nodes.size(); ++node) {
        const Eigen::Vector3d x = part.fe.nodes[node].position;
        rate[part.fe.dofs.node_dofs[node][2]] = 0.5 * x[0] * x[0];
      }
      part.sieve.apply(rate);
      state.bodies[0].d_dot = rate;
    });
  }
};

/// Largest changes in so many steps, relative to what there is at the start.
struct Drift {
  double energy = 0, angular = 0, linear = 0;
  SolveCounts counts;
};

Drift drift(const Turning& block, int kept_solves, int steps) {
  Stepper stepper(block.model, ringing_steps(kept_solves), block.start.rows_in_use);
  model::State state = block.start.state;
  const auto energy = [&] { return dynamics::energy(block.model, state).total(); };
  const double energy_before = energy();
  const dynamics::Momentum before = dynamics::momentum(block.model, state);
  Drift out;
  for (int k = 0; k < steps; ++k) {
    stepper.step(state);
    const dynamics::Momentum now = dynamics::momentum(block.model, state);
    out.energy = std::max(out.energy, std::abs(energy() - energy_before) / energy_before);
    out.angular =
        std::max(out.angular, (now.angular - before.angular).norm() / before.angular.norm());
    out.linear = std::max(out.linear, (now.linear - before.linear).norm());
  }
  out.counts = stepper.counts(0);
  return out;
}

TEST(RecycledSteps, KeepEnergyAndMomentumAsWellAsTwoSolves) {
  constexpr int kSteps = 600;
  const Turning block;
  const Drift two = drift(block, 0, kSteps);
  const Drift kept = drift(block, 80, kSteps);
  EXPECT_GE(two.counts.solves, 2 * kSteps - 10);
  EXPECT_GE(kept.counts.recycled, kSteps * 3 / 4) << kept.counts.solves;
  EXPECT_LE(kept.energy, 1.02 * two.energy);
  EXPECT_LE(kept.angular, 1.02 * two.angular);
  EXPECT_LE(kept.linear, 1e-9);
  for (const auto& [name, value] : {std::pair{"energy", two.energy},
                                    {"energy_kept", kept.energy},
                                    {"angular", two.angular},
                                    {"angular_kept", kept.angular},
                                    {"linear", two.linear},
                                    {"linear_kept", kept.linear}}) {
    RecordProperty(name, fmt::format("{:.3e}", value));
  }
}

TEST(RecycledSteps, AreBitwiseTheSameWithTwoThreads) {
  const model::Model model = released_blocks({40, 6, 6});
  StepSettings settings = ringing_steps(20);
  const Outcome one = after(model, settings, 60);
  settings.threads = 2;
  const Outcome two = after(model, settings, 60);
  EXPECT_GT(one.counts.recycled, 0);
  EXPECT_EQ(one.counts.recycled, two.counts.recycled);
  buckens::test::expect_same(one.end, two.end);
}

TEST(RecycledSteps, GoOnBitwiseFromWhatWasSaved) {
  const model::Model model = released_blocks({20, 4, 4});
  const Start start = buckens::test::consistent_start(model);
  const StepSettings settings = ringing_steps(80);
  Stepper stepper(model, settings, start.rows_in_use);
  model::State state = start.state;
  for (int k = 0; k < 60; ++k) stepper.step(state);
  base::SavedValues saved;
  stepper.visit_saved(base::SaveVisit::saving(saved));
  Stepper other(model, settings, start.rows_in_use);
  other.visit_saved(base::SaveVisit::restoring(saved));
  model::State further = state;
  for (int k = 0; k < 60; ++k) {
    stepper.step(state);
    other.step(further);
  }
  buckens::test::expect_same(state, further);
  EXPECT_GT(other.counts(0).recycled, 20);
}

TEST(RecycledSteps, EqualBodiesShareWhatIsKept) {
  const std::array<int, 3> divisions = {20, 4, 4};
  const model::Model two = released_blocks(divisions, 2);
  const Start start = buckens::test::consistent_start(two);
  Stepper stepper(two, ringing_steps(80), start.rows_in_use);
  model::State state = start.state;
  for (int k = 0; k < 300; ++k) stepper.step(state);
  const Outcome alone = after(released_blocks(divisions), ringing_steps(80), 300);
  // They move alike, so that both ask for the same in the same step, and one pair answers both.
  EXPECT_EQ(stepper.counts(0).solves, alone.counts.solves);
  EXPECT_EQ(stepper.counts(1).solves, alone.counts.solves);
  const Eigen::Vector3d lever = state.bodies[1].frame.X_WB.p - state.bodies[0].frame.X_WB.p;
  EXPECT_LT((lever - Eigen::Vector3d(0, 0, 0.5)).norm(), 1e-13);
}

TEST(RecycledSteps, NothingIsKeptWhereCouplingIsIterated) {
  const model::Model model = released_blocks({20, 4, 4});
  StepSettings settings = ringing_steps(80);
  settings.iterate_coupling = true;
  EXPECT_EQ(after(model, settings, 50).counts.recycled, 0);
}

}  // namespace
}  // namespace buckens::stepping
