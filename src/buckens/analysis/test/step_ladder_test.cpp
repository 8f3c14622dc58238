// SPDX-License-Identifier: Apache-2.0
// The counts of the ladder match the work done, and discarded rungs leave no trace.
#include "buckens/stepping/step_ladder.h"

#include <gtest/gtest.h>

#include "buckens/body/reduced_basis.h"
#include "buckens/body/reduction.h"
#include "buckens/dynamics/test/example_models.h"
#include "buckens/stepping/test/same_state.h"
#include "buckens/stepping/test/simulate.h"

namespace buckens::stepping {
namespace {

test::BeamConstants eight_elements() {
  test::BeamConstants beam;
  beam.EA = 2e4;
  beam.EIz = beam.EIy = 20;
  beam.elements = 8;
  return beam;
}

/// Three beams in a row: two alike, of one factor, and one reduced to its vibrations, of none; a
/// rigid rod hangs on the last.
model::Model twins_and_a_reduced_one() {
  test::Mechanism m(spatial::Plane::xy);
  m.set_gravity({0, -9.81, 0});
  m.set_length(4.0);
  const auto beam = [&](double x) {
    return m.add_flexible(test::straight_beam(eight_elements(), spatial::Plane::xy), {},
                          {{x, 0, 0}, Eigen::Quaterniond::Identity()});
  };
  const int bodies[3] = {beam(0), beam(1), beam(2)};
  const int rod = test::add_rod(m, 1.0, 1.0, {{3.5, 0, 0}, Eigen::Quaterniond::Identity()});
  m.add_joint(joints::JointType::revolute, test::Mechanism::ground({0, 0, 0}),
              m.node_marker(bodies[0], 0));
  m.add_joint(joints::JointType::revolute, m.node_marker(bodies[0], 8),
              m.node_marker(bodies[1], 0));
  m.add_joint(joints::JointType::revolute, m.node_marker(bodies[1], 8),
              m.node_marker(bodies[2], 0));
  m.add_joint(joints::JointType::revolute, m.node_marker(bodies[2], 8),
              m.rigid_marker(rod, {-0.5, 0, 0}));
  model::Model model = m.take();
  body::Body& last = model.bodies[2];
  const body::ReducedBasis basis = body::free_free_basis("last", *last.flexible, 5, true, 1.0);
  last.flexible = body::reduce("last", *last.flexible, basis);
  return model;
}

TEST(StepLadder, CountsWhatIsDone) {
  const model::Model model = twins_and_a_reduced_one();
  const test::Start start = test::consistent_start(model);
  StepSettings settings;
  settings.step = 1e-3;
  StepLadder ladder(model, settings, start.rows_in_use);
  ladder.rung(2);
  for (const int k : {0, 2}) EXPECT_EQ(ladder.factorisations(k), 1) << "one for both twins";
  EXPECT_EQ(ladder.factorisations(1), 0) << "never asked for";
  EXPECT_EQ(ladder.factorisations(7), 0);
  long sum = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) sum += ladder.counts(b).factorisations;
  EXPECT_EQ(sum, ladder.factorisations(0) + ladder.factorisations(2));
  EXPECT_EQ(ladder.counts(2).factorisations, 0) << "reduced";
}

/// Factors of this size: one fits within the limit, two do not.
StepLadder::Limits room_for_one(const model::Model& model, const StepSettings& settings,
                                const std::vector<int>& rows) {
  StepLadder::Limits limits;
  limits.most_entries = 1.5 * Stepper(model, settings, rows).factor_entries();
  return limits;
}

TEST(StepLadder, GivesUpTheRungNotUsedForLongest) {
  const model::Model model = twins_and_a_reduced_one();
  const test::Start start = test::consistent_start(model);
  StepSettings settings;
  settings.step = 1e-3;
  StepLadder::Limits limits;
  limits.most_kept = 3;
  StepLadder ladder(model, settings, start.rows_in_use, limits);
  for (const int k : {1, 2, 0, 3}) ladder.rung(k);  // 1 has waited for longest when 3 comes
  EXPECT_EQ(ladder.num_kept(), 3U);
  for (const int k : {0, 2, 3}) {
    ladder.rung(k);
    EXPECT_EQ(ladder.factorisations(k), 1) << k;
  }
  ladder.rung(1);
  EXPECT_EQ(ladder.factorisations(1), 2) << "given up and made again";
  EXPECT_EQ(ladder.counts(0).factorisations, 5);
}

TEST(StepLadder, KeepsTwoHoweverLargeTheirFactors) {
  const model::Model model = twins_and_a_reduced_one();
  const test::Start start = test::consistent_start(model);
  StepSettings settings;
  settings.step = 1e-3;
  StepLadder ladder(model, settings, start.rows_in_use,
                    room_for_one(model, settings, start.rows_in_use));
  for (const int k : {1, 2, 3, 2, 3}) {
    ladder.rung(k);
    EXPECT_EQ(ladder.num_kept(), 2U);
  }
  for (const int k : {0, 1, 2, 3}) EXPECT_EQ(ladder.factorisations(k), 1) << k;
}

TEST(StepLadder, WhatWasGivenUpLeavesNoTrace) {
  const model::Model model = twins_and_a_reduced_one();
  const test::Start start = test::consistent_start(model);
  StepSettings settings;
  settings.step = 4e-3;
  StepLadder roomy(model, settings, start.rows_in_use);
  StepLadder narrow(model, settings, start.rows_in_use,
                    room_for_one(model, settings, start.rows_in_use));
  model::State a = start.state;
  model::State b = start.state;
  long steps = 0;
  for (const int k : {0, 1, 2, 1, 0, 3, 2, 0, 1}) {
    roomy.rung(k).step(a);
    narrow.rung(k).step(b);
    EXPECT_EQ(&narrow.latest(), &narrow.rung(k));
    ++steps;
  }
  test::expect_same(a, b);
  EXPECT_GT(narrow.counts(0).factorisations, roomy.counts(0).factorisations);
  // Solves of discarded factors remain counted.
  EXPECT_EQ(narrow.counts(0).solves, roomy.counts(0).solves);
  EXPECT_GE(narrow.counts(0).solves, steps);
}

}  // namespace
}  // namespace buckens::stepping
