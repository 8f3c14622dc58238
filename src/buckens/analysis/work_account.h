// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/model/model.h"
#include "buckens/model/state.h"
#include "buckens/results/observation.h"

namespace buckens::analysis {

/// Integrates the work of loads, drives and dampers over the steps of a run: trapezoidal rule, so
/// its error is of the order h² like that of the steps.
class WorkAccount {
 public:
  WorkAccount(const model::Model& model, const model::State& start);

  /// Adds the work between the last state and this one.
  void add(const model::State& state);

  const results::WorkBalance& work() const { return work_; }
  /// What work() was before the last add().
  const results::WorkBalance& work_before() const { return work_before_; }
  /// ∫|P| dt [J]: measures how much energy went through the mechanism.
  double turnover() const { return turnover_; }

 private:
  struct Powers {
    double active = 0;   ///< of loads [W]
    double damping = 0;  ///< of meshes and dampers [W]
    linalg::Vector g_t;  ///< ∂g/∂t of the joints
  };
  Powers powers(const model::State& state) const;

  const model::Model& model_;
  Powers before_;
  double t_ = 0;
  linalg::Vector lambda_before_, lambda_start_;  ///< as carried; at the last state
  double lambda_time_ = 0;                       ///< instant of lambda_before_
  results::WorkBalance work_, work_before_;
  double turnover_ = 0;
};

}  // namespace buckens::analysis
