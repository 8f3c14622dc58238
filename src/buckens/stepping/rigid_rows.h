// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/multiplier_condensation.h"
#include "buckens/loads/force_element.h"
#include "buckens/model/model.h"
#include "buckens/model/state.h"
#include "buckens/stepping/scheme.h"

namespace buckens::stepping {

/// The rigid rows of force laws within one step: the state of each in its set, and its force.
/// Theory: docs/theory/22-rows.md §5, docs/theory/23-impacts.md §1.
class RigidRows {
 public:
  /// @param scheme of the steps; null outside of them
  explicit RigidRows(const model::Model& model, const Scheme* scheme = nullptr);

  bool empty() const { return first_states_.empty(); }
  /// Takes the stands that a state remembers.
  /// @param undone fraction of its force that a row on a mesh applies when it lets go, to take back
  ///        what it has pushed since the start of the step, (I8); 0 outside of steps
  void start(const model::RowMemory& memory, double undone = 0.0);
  /// One per Load::rigid_row, in memory that stays in place.
  const std::vector<loads::RowStand>& stands() const { return stands_; }
  void add_force(int row, double change) { stands_[static_cast<std::size_t>(row)].force += change; }
  /// Moves rows to the stands that follow from their sets.
  /// @param decided_elsewhere per rigid row, those that stay as they are; empty: none
  /// @return whether a regime changed
  bool move(const std::vector<loads::RigidRow>& rows,
            const std::vector<char>& decided_elsewhere = {});
  /// Opens rows whose contact point has disappeared, within the iteration: their force would act
  /// at a point that no longer exists. @return whether any of them was closed
  bool let_go(const std::vector<loads::RigidRow>& rows);
  /// The same of one row.
  void let_go(int row);
  /// Moves one row. @return whether its regime changed
  bool put(int row, const loads::RowStand& stand);
  /// Counts a move of rows that were put.
  void count_move() { ++num_moves_; }
  /// Whether a closed end on a mesh with strong damping pulls at the end of the step, but has
  /// pushed over the step as a whole.
  bool only_pulls_at_end(int row) const;
  /// Whether an end on a mesh that was closed at the start of the step has let go, or pushes over
  /// the step as a whole but pulls at its end, or the other way round.
  bool ends_have_turned() const;
  /// Regime changes in this step.
  int num_moves() const { return num_moves_; }
  /// Whether any regime differs from that at the start of the step, or friction of a ball has
  /// turned so far that accelerations have jumped.
  bool have_changed() const;

 private:
  /// The stand of an open row: with a force of its own in a step in which it lets go.
  loads::RowStand open(std::size_t row) const { return {0, 0.0, released_[row]}; }

  std::vector<int> first_states_;       // in RowMemory::laws, per rigid row
  std::vector<std::size_t> loads_;      // index into Model::loads, per rigid row
  std::vector<char> is_on_mesh_;        // per rigid row: what it holds if a mesh is involved
  std::vector<char> slides_;            // per rigid row: along which directions its friction does
  std::vector<char> turns_by_damping_;  // per rigid row: on a mesh whose damping reverses rates
  std::vector<loads::RowStand> stands_;
  std::vector<double> released_;  // force of a row that lets go in this step
  std::vector<int> regimes_at_start_;
  int num_moves_ = 0;
};

/// A closed rigid row yields by this fraction of its own compliance, so that two rows that hold the
/// same thing leave the matrix regular.
inline constexpr double kRigidGive = 1e-10;

/// Factorises rows of joints and closed rigid rows. The latter yield only if some rows depend on
/// each other, because this costs digits of the forces. @param give per rigid row, see kRigidGive
/// @return false if joints are dependent
bool factorise_closed_rows(dynamics::MultiplierCondensation& condensation,
                           const std::vector<dynamics::SystemRow>& rows,
                           const std::vector<dynamics::BodyCompliance>& compliance,
                           const std::vector<double>& give);

/// Displacement of a row per force along it, if both bodies respond alone [m/N], [rad/(N m)].
double own_compliance(const dynamics::SystemRow& row,
                      const std::vector<dynamics::BodyCompliance>& compliance);

}  // namespace buckens::stepping
