// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "buckens/linalg/matrix_types.h"

namespace buckens::analysis {

/// Accelerates rounds x → g(x) of a linear problem that converge slowly or not at all: takes the
/// combination of previous rounds whose change is smallest (Anderson 1965; for linear g this is the
/// method of conjugate residuals). Theory: docs/theory/08-coupling.md.
class MixedRounds {
 public:
  /// @param x start of a round @param g its result
  /// @return start of the next round
  linalg::Vector mix(const linalg::Vector& x, const linalg::Vector& g) {
    linalg::Vector change = g - x;
    if (last_change_.size() > 0) keep(change - last_change_, g - last_);
    last_change_ = change;
    last_ = g;
    linalg::Vector next = g;
    for (std::size_t k = 0; k < changes_.size(); ++k) {
      next -= changes_[k].dot(change) * ends_[k];
    }
    return next;
  }

 private:
  // More are forgotten together; coupling of one body shows itself in six.
  static constexpr std::size_t kMostKept = 12;
  // A difference with less of its own is rounding.
  static constexpr double kOwnShare = 1e-8;

  /// Keeps changes orthonormal, and the differences of results along them.
  void keep(linalg::Vector change, linalg::Vector end) {
    if (changes_.size() == kMostKept) {
      changes_.clear();
      ends_.clear();
    }
    const double size = change.norm();
    for (std::size_t k = 0; k < changes_.size(); ++k) {
      const double along = changes_[k].dot(change);
      change -= along * changes_[k];
      end -= along * ends_[k];
    }
    const double own = change.norm();
    if (!(own > kOwnShare * size)) return;
    changes_.push_back(change / own);
    ends_.push_back(end / own);
  }

  std::vector<linalg::Vector> changes_, ends_;
  linalg::Vector last_change_, last_;
};

}  // namespace buckens::analysis
