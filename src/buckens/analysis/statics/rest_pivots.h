// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/analysis/statics/system.h"

namespace buckens::analysis {

/// Finds which one-sided rows are closed at the end of one linear step:
///
///     gap + J δx ≥ 0,   f + δf ≥ 0,   one of them zero, row by row
///
/// by principal pivots from the rows that are closed now: all rows that disagree at once while
/// their number falls, else the last of them alone, which comes to an end for any positive definite
/// matrix (Júdice and Pires 1994).
class RestPivots {
 public:
  explicit RestPivots(const StaticSystem& system) : system_(system) {}

  /// Looks at the step that was found with `point`'s rows. @return whether any have moved: then
  /// the step must be found again
  /// @throws NumericalError naming the rows that do not settle
  bool revise(const StaticBalance& balance, const linalg::Vector& step, StaticPoint& point);

 private:
  std::vector<std::size_t> disagreeing(const StaticBalance& balance, const linalg::Vector& step,
                                       const StaticPoint& point) const;

  const StaticSystem& system_;
  std::size_t fewest_ = static_cast<std::size_t>(-1);
  int patience_ = 0, rounds_ = 0;
};

}  // namespace buckens::analysis
