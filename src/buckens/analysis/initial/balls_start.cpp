// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/initial/balls_start.h"

#include <algorithm>

#include "buckens/analysis/initial/frame_acceleration.h"
#include "buckens/analysis/initial/quasi_static_start.h"
#include "buckens/dynamics/forces.h"
#include "buckens/stepping/ball_cones.h"

namespace buckens::analysis {

namespace {

// Directions change from one to the next only as reactions do, which press the balls. What is left
// after so many is decided by the first step.
constexpr int kMostAims = 30;

class BallsStart {
 public:
  BallsStart(const model::Model& model, model::State& state)
      : model_(model), state_(state), cones_(model), rigid_(model) {
    if (cones_.empty()) return;
    rigid_.start(state.memory);
    for (const body::Body& body : model.bodies) {
      compliance_.push_back({dynamics::frame_mobility(body, body.J0), nullptr});
    }
  }

  bool has_any() const { return !cones_.empty() && cones_.any_slides(rigid_); }

  /// Decides the stands from the accelerations. @return whether any has changed
  bool aim(const std::vector<int>& rows_in_use) {
    const auto motions = dynamics::motions_of(model_, state_);
    const dynamics::Circumstances around = dynamics::circumstances_of(state_);
    dynamics::evaluate_soft_rows(model_, motions, state_.t, around, soft_);
    dynamics::Forces forces;
    dynamics::evaluate_forces(model_, motions, state_.t, around, forces);
    take_torques();
    foresee(motions, forces.rigid);
    const stepping::RigidInstant now{forces.rigid, soft_,  compliance_, motions,
                                     rows_in_use,  around, state_.t};
    stepping::BallCones::Stage stage;
    stage.begins = true;
    if (!cones_.decide(now, stage, 1.0, 1.0, rigid_)) return false;
    write();
    return true;
  }

 private:
  bool owns(const model::Load& load) const {
    return load.rigid_row >= 0 && cones_.rows()[static_cast<std::size_t>(load.rigid_row)] != 0;
  }

  /// Those that hold balls, as the accelerations have found them.
  void take_torques() {
    for (const model::Load& load : model_.loads) {
      if (!owns(load) || state_.memory.laws[load.first_state] != 1.0) continue;
      rigid_.put(load.rigid_row, {1, state_.memory.laws[load.first_state + 1]});
    }
  }

  void write() {
    for (const model::Load& load : model_.loads) {
      if (!owns(load)) continue;
      const loads::RowStand& stand = rigid_.stands()[static_cast<std::size_t>(load.rigid_row)];
      // A direction that is held is one within a step.
      state_.memory.laws[load.first_state] =
          std::min(stand.regime, loads::RigidLaw::kHeldDirection - 1);
      state_.memory.laws[load.first_state + 1] = stand.force;
    }
  }

  /// Rates as they are about to become: the accelerations of the rows.
  void foresee(const std::vector<dynamics::BodyMotion>& motions,
               std::vector<loads::RigidRow>& rows) const {
    for (std::size_t k = 0; k < soft_.rows.size(); ++k) {
      if (soft_.rigid[k] < 0) continue;
      const model::Load& load = model_.load_of_rigid_row(soft_.rigid[k]);
      if (!owns(load)) continue;
      rows[static_cast<std::size_t>(soft_.rigid[k])].slip =
          frame_acceleration(model_, load, soft_.rows[k], motions, state_);
    }
  }

  const model::Model& model_;
  model::State& state_;
  stepping::BallCones cones_;
  stepping::RigidRows rigid_;
  std::vector<dynamics::BodyCompliance> compliance_;
  dynamics::SoftRows soft_;
};

}  // namespace

void aim_balls(const model::Model& model, const dynamics::MassMetric& metric,
               const std::vector<int>& rows_in_use, model::State& state) {
  if (model.num_rigid_rows() == 0) return;
  BallsStart balls(model, state);
  if (!balls.has_any()) return;
  for (int round = 0; round < kMostAims && balls.aim(rows_in_use); ++round) {
    settle_accelerations(model, metric, rows_in_use, state);
  }
}

}  // namespace buckens::analysis
