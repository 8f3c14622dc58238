// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/initial/rigid_rows_start.h"

#include <string>

#include <fmt/format.h>

#include "buckens/analysis/initial/quasi_static_start.h"
#include "buckens/base/errors.h"
#include "buckens/dynamics/forces.h"

namespace buckens::analysis {

namespace {

constexpr int kMostRowRounds = 50;

/// Moves rows to the stands that follow. @return names of the loads that moved
/// @param released per rigid row: what has once let go here is not closed again, since at a rate of
///        nearly zero its sign says nothing
std::string move_rows(const model::Model& model, std::vector<char>& released, model::State& state) {
  dynamics::Forces forces;
  dynamics::evaluate_forces(model, dynamics::motions_of(model, state), state.t,
                            dynamics::circumstances_of(state), forces);
  std::string names;
  for (const model::Load& load : model.loads) {
    if (load.rigid_row < 0) continue;
    const loads::RowStand& next = forces.rigid[static_cast<std::size_t>(load.rigid_row)].next;
    double* const stand = state.memory.laws.data() + load.first_state;
    if (static_cast<int>(stand[0]) == next.regime) continue;
    char& has_let_go = released[static_cast<std::size_t>(load.rigid_row)];
    if (has_let_go) continue;
    has_let_go = forces.rigid[static_cast<std::size_t>(load.rigid_row)].is_closed;
    stand[0] = next.regime;
    stand[1] = next.force;
    names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", load.name);
  }
  return names;
}

}  // namespace

void settle_rigid_rows(const model::Model& model, const dynamics::MassMetric& metric,
                       const std::vector<int>& rows_in_use, model::State& state) {
  std::string moved;
  std::vector<char> released(static_cast<std::size_t>(model.num_rigid_rows()));
  for (int round = 0; round < kMostRowRounds; ++round) {
    settle_accelerations(model, metric, rows_in_use, state);
    if (model.num_rigid_rows() == 0) return;
    moved = move_rows(model, released, state);
    if (moved.empty()) return;
  }
  throw NumericalError(
      fmt::format("at t = {:.6g} s no combination of holding and releasing satisfies all of the "
                  "rigid loads {}; give one of them a stiffness, or friction `stick: elastic`",
                  state.t, moved));
}

}  // namespace buckens::analysis
