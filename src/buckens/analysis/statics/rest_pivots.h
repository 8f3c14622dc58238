// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "buckens/analysis/statics/system.h"

namespace buckens::analysis {

/// Finds which one-sided rows are closed at the end of one linear step:
///
///     gap + J δx ≥ 0,   f + δf ≥ 0,   one of them zero, row by row
///
/// by principal pivots, starting from the rows that are closed now: all rows that disagree at once
/// as long as their number falls, otherwise only the last of them. This terminates for any positive
/// definite matrix (Júdice and Pires 1994), but possibly not where forces on curved surfaces make
/// the matrix indefinite.
class RestPivots {
 public:
  explicit RestPivots(const StaticSystem& system) : system_(system) {}

  enum class Outcome {
    settled,  ///< all rows agree with the step
    moved,    ///< some have moved: the step must be found again
    lost      ///< they do not settle, see lost_text()
  };
  /// Checks the step that was found with the rows of `point`.
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
