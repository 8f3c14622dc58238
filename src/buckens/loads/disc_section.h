// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include <Eigen/Core>

namespace buckens::loads {

/// A convex polygon that planes cut, corners counter-clockwise.
struct ConvexSection {
  /// A rectangle, cut by the six faces of a box.
  static constexpr std::size_t kMostCorners = 12;
  std::array<Eigen::Vector2d, kMostCorners> corners;
  std::size_t count = 0;

  static ConvexSection rectangle(double half_x, double half_y);
  /// Keeps what has value + slope·x ≤ 0.
  void cut(double value, const Eigen::Vector2d& slope);
  /// Distance of the origin, 0 inside. @pre count > 0
  double distance() const;
};

/// Integrals over an area, and that of a linear function.
struct SectionSums {
  double area = 0;
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  double depth = 0;
};

/// Integrals over the part of a polygon within a disc about the origin; exact, and without
/// cancellation where that part is thin.
/// @param value,slope of the depth −(value + slope·x)
SectionSums sums_within_disc(const ConvexSection& polygon, double radius, double value,
                             const Eigen::Vector2d& slope);

}  // namespace buckens::loads
