// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "buckens/dynamics/test/mechanism.h"
#include "buckens/stepping/time_march.h"

namespace buckens::verification::step_control {

/// A run with step control whose longest step is a twentieth of its duration.
inline stepping::MarchSettings controlled(double duration, double tolerance) {
  return {duration, 0, 20, stepping::ErrorTolerance{tolerance, 1e-9}};
}

/// State at the end; `visit(before, after)` sees every accepted step.
template <class Visit>
model::State walk(stepping::TimeMarch& march, const test::Start& start, Visit visit) {
  model::State before;
  model::State after = start.state;
  while (!march.is_done()) {
    std::swap(before, after);
    march.advance(before, after);
    visit(before, after);
  }
  return after;
}
inline model::State walk(stepping::TimeMarch& march, const test::Start& start) {
  return walk(march, start, [](const model::State&, const model::State&) {});
}

}  // namespace buckens::verification::step_control
