// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "buckens/analysis/statics/system.h"

namespace buckens::analysis {

/// Finds which one-sided rows are closed at the end of one linear step:
///
///     gap + J δx ≥ 0,   f + δf ≥ 0,   one of them zero, row by row
///
/// by principal pivots from the rows that are closed now: all rows that disagree at once while
/// their number falls, else the last of them alone, which comes to an end for any positive definite
/// matrix (Júdice and Pires 1994). Where forces on curved surfaces make it indefinite, it may not.
class RestPivots {
 public:
  explicit RestPivots(const StaticSystem& system) : system_(system) {}

  enum class Outcome {
    settled,  ///< all rows agree with the step
    moved,    ///< some have moved: the step must be found again
    lost      ///< they find no end, see lost_text()
  };
  /// Looks at the step that was found with `point`'s rows.
  Outcome revise(const StaticBalance& balance, const linalg::Vector& step, StaticPoint& point);
  /// Names the rows that do not settle.
  const std::string& lost_text() const { return lost_text_; }

 private:
  std::vector<std::size_t> disagreeing(const StaticBalance& balance, const linalg::Vector& step,
                                       const StaticPoint& point) const;

  const StaticSystem& system_;
  std::size_t fewest_ = static_cast<std::size_t>(-1);
  int patience_ = 0, rounds_ = 0;
  std::string lost_text_;
};

}  // namespace buckens::analysis
