// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "buckens/analysis/initial/impulses.h"

namespace buckens::analysis {

/// Forces that jump at an instant, by samples of signals or values from outside, and the
/// accelerations that jump with them.
///
/// Methods that carry accelerations into the next step would otherwise begin it with those of the
/// forces before the jump, an error of first order in the step. Theory: docs/theory/24-control.md
/// §3.
class ForceJump {
 public:
  explicit ForceJump(const model::Model& model) : model_(model) {}

  /// Notes the forces before the jump.
  /// @param signals t and the values of all signals then; null: as the state has them
  void note(const model::State& state, const std::vector<double>* signals = nullptr);
  /// Changes the accelerations of bodies, and those that the method carries, by what the change of
  /// forces since note() does, joints and closed rigid rows being kept. Meshes move as far as steps
  /// resolve it. Nothing happens where no force has changed.
  /// @param stepper of the next step
  /// @throws NumericalError where the joint equations are dependent
  void pass(const stepping::Stepper& stepper, model::State& state);

 private:
  void find_forces(const model::State& state, const std::vector<double>* signals);
  /// @return whether any force has changed
  bool find_changes();

  const model::Model& model_;
  std::vector<dynamics::BodyMotion> motions_;
  dynamics::Forces forces_;
  std::optional<Impulses> rows_;
  const stepping::Stepper* of_ = nullptr;        // that rows_ was made for
  std::vector<dynamics::BodyResponse> changes_;  // of forces; before pass() minus the old ones
};

}  // namespace buckens::analysis
