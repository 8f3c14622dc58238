// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace buckens_petsc {

/// How much room a factor and its waiting fronts get on one process, try after try.
///
/// Processes get fronts as they have time for them, so that the largest need is known afterwards
/// only. A first try may do with less than MUMPS predicts: what lacked is added then, some times
/// over, but not more than the prediction, and after that MUMPS gets multiples of it. All processes
/// have the same number of tries.
class FactorRoom {
 public:
  /// @param first numbers of the first try, @param predicted by MUMPS, its relaxation included
  FactorRoom(double first, double predicted) : numbers_(first), predicted_(predicted) {}

  double numbers() const { return numbers_; }
  /// @param lacking numbers for which there was no room on some process, the same on all; 0:
  /// unknown
  /// @return whether there is another try
  bool grow(double lacking);

 private:
  double numbers_, predicted_;
  int additions_ = 0, multiples_ = 0;
};

/// The process that needs least, or the first if it is hardly worth changing places.
/// @param numbers of each process, all more than 0
int lightest_place(const std::vector<double>& numbers);

}  // namespace buckens_petsc
