// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/stepping/push_answers.h"

namespace buckens::stepping {

/// The smallest motion that takes bodies out of the ends of stops into which a step has led them.
///
/// Where joints permit, it is a motion of frames only: meshes, which would store energy in it,
/// yield by a billionth of what they would in the metric of a step. Joints stay closed. Theory:
/// docs/theory/23-impacts.md §2.
class StopClearance {
 public:
  explicit StopClearance(const model::Model& model) : answers_to_(model) {}

  /// Motion of one body.
  struct Shift {
    Vector6 frame = Vector6::Zero();  ///< body axes [rad], world axes [m]
    Eigen::VectorXd impulse_time;     ///< on interface rows, as BodyJump::impulse_time; empty: none
  };
  /// One end: its row, pointing away from it, and its gap, negative beyond the end [m] or [rad].
  struct End {
    dynamics::SystemRow row;
    double gap = 0;
  };

  /// @param compliance as for impulses, @param motions where rows and joints are taken
  /// @param holding rigid rows of force laws that stay closed, too
  /// @return empty if nothing has to move, or if joints have become dependent
  std::vector<Shift> find(const std::vector<End>& ends,
                          const std::vector<dynamics::BodyCompliance>& compliance,
                          const std::vector<dynamics::BodyMotion>& motions,
                          const std::vector<int>& rows_in_use,
                          const std::vector<dynamics::SystemRow>& holding,
                          const model::RowMemory* memory, double t);

 private:
  PushAnswers answers_to_;
};

}  // namespace buckens::stepping
