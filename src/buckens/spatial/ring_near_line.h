// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>

namespace buckens::spatial {

/// Unit vector from the middle of a circle to the place of it that is nearest to a line, on one
/// side of the line's middle; where nothing is nearest on that side, to the nearest of all. Exact
/// to rounding. A line that runs rather along the circle's axis than across has one for both sides.
///
/// Seen along the line, the circle is an ellipse and the line a point: on the far side of the long
/// axis an ellipse has a nearest place only for points within its evolute.
/// @param axis unit vector of the circle, @param r from its middle to a point of the line
/// @param along unit vector, @param towards 1 or −1
Eigen::Vector3d towards_line(const Eigen::Vector3d& axis, double radius, const Eigen::Vector3d& r,
                             const Eigen::Vector3d& along, double towards);

}  // namespace buckens::spatial
