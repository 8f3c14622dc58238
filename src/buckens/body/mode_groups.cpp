// SPDX-License-Identifier: Apache-2.0
#include "buckens/body/mode_groups.h"

#include <algorithm>

namespace buckens::body {

using Eigen::Index;

namespace {

constexpr double kTogether = 1e-3;

/// End of the group to which vibration `count` − 1 belongs. @param omega ascending
Index end_of_group(const linalg::Vector& omega, Index count) {
  Index end = std::min(count, omega.size());
  if (end == 0) return 0;
  const double bound = (1.0 + kTogether) * omega[end - 1];
  while (end < omega.size() && omega[end] <= bound) ++end;
  return end;
}

FreeModes first_of(const FreeModes& modes, Index count) {
  return {modes.omega.head(count), modes.shapes.leftCols(count)};
}

}  // namespace

FreeModes lowest_groups(int count, const ModeSolver& lowest) {
  if (count == 0) return lowest(0);
  for (int more = 1;; more *= 2) {
    const FreeModes found = lowest(count + more);
    const Index end = end_of_group(found.omega, count);
    // The group may continue beyond the last requested one.
    if (end < count + more) return first_of(found, end);
  }
}

FreeModes groups_up_to(double cutoff, int first_trial, const ModeSolver& lowest) {
  for (int count = first_trial;; count *= 2) {
    const FreeModes found = lowest(count);
    Index end =
        std::upper_bound(found.omega.begin(), found.omega.end(), cutoff) - found.omega.begin();
    end = end_of_group(found.omega, end);
    if (end < count) return first_of(found, end);
  }
}

}  // namespace buckens::body
