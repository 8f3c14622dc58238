// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/analysis/initial/assembly_moves.h"
#include "buckens/dynamics/mass_metric.h"
#include "buckens/model/build/build_model.h"
#include "buckens/model/build/rigid_pairs.h"
#include "buckens/model/state.h"

namespace buckens::analysis {

/// A mechanism ready to move: assembled, with consistent velocities, accelerations and multipliers.
struct Prepared {
  model::State state;
  std::vector<int> rows_in_use;             ///< independent rows of λ
  std::vector<char> released;               ///< joints that have let go where these were chosen
  std::vector<int> redundant_rows;          ///< those that follow from them
  std::vector<std::string> redundant_text;  ///< by joint: "hinge_2: 5 of 5 equations follow …"
  std::vector<AssemblyMove> moves;          ///< moves of the bodies by position assembly
  std::vector<std::string> notes;           ///< what a user should know about the start
  std::vector<std::string> warnings;        ///< about implausible values
  long setup_factorisations = 0;            ///< of a static start
};

/// Assembles positions, finds redundant joints, starts statically if requested, projects velocities
/// and computes accelerations at t = 0.
/// @throws ModelError naming the joint that cannot be closed or the body that is not held, or if
/// strict assembly would move a body
/// @param pairs of this model, to be given loads of those that are near each other at the start;
///        null: rigid contact groups are left out
Prepared prepare(const model::BuiltModel& built, const dynamics::MassMetric& metric,
                 model::RigidPairs* pairs = nullptr);

}  // namespace buckens::analysis
