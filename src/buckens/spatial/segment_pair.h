// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>

namespace buckens::spatial {

/// The nearest places of two segments, as parameters −1 … 1 from the middles.
struct NearestOfSegments {
  double on_first = 0, on_second = 0;
  bool first_is_free = false, second_is_free = false;  ///< between its ends

  /// Halfway along where they run side by side.
  /// @param r from the middle of the first to that of the second, @param a,b half segments, the
  /// second not empty
  static NearestOfSegments of(const Eigen::Vector3d& r, const Eigen::Vector3d& a,
                              const Eigen::Vector3d& b);
  /// Of the lines that go on beyond the segments. @pre they are not parallel
  static NearestOfSegments of_lines(const Eigen::Vector3d& r, const Eigen::Vector3d& a,
                                    const Eigen::Vector3d& b);
  /// Rates of both parameters.
  /// @param r,a,b as above, @param r_rate,a_rate,b_rate their rates
  Eigen::Vector2d rates(const Eigen::Vector3d& r, const Eigen::Vector3d& a,
                        const Eigen::Vector3d& b, const Eigen::Vector3d& r_rate,
                        const Eigen::Vector3d& a_rate, const Eigen::Vector3d& b_rate) const;
};

}  // namespace buckens::spatial
