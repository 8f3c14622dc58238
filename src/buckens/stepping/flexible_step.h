// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "buckens/linalg/recycled_solves.h"
#include "buckens/stepping/lagged_coupling.h"
#include "buckens/stepping/large_step.h"

namespace buckens::stepping {

/// The n-sized part of one flexible body in a step, its coupling, and its large solves so far.
struct FlexibleStep {
  FlexibleStep(const body::Body& body, BodyStepOperator& op)
      : name(body.name), large(op), coupling(body, op) {}

  std::string name;       ///< of the body
  std::size_t index = 0;  ///< in the model

  LargeStep large;
  LaggedCoupling coupling;
  linalg::RecycledSolves::Request request;  ///< of the first change of load of this step
  body::FrameMotion frame_at_end;           ///< of the last step; tells whether the next goes on
  long solves = 0;
  long recycled = 0;         ///< answers combined from kept solves
  long iterations = 0;       ///< of solves that iterate
  double solve_seconds = 0;  ///< the same, wall time
};

}  // namespace buckens::stepping
