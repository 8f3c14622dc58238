// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

namespace buckens::fem {

/// How a beam gets from point to point.
enum class BeamPath { polyline, arc, spline };

constexpr std::array<const char*, 3> choice_names(BeamPath) {
  return {"polyline", "arc", "spline"};
}

/// Divides the way through points into straight pieces whose ends lie on it exactly.
///
/// An arc is part of the circle through three points and is divided into equal angles. A polyline
/// and a spline have a node at every given point; the pieces between two of them are of one length,
/// and of their number each stretch has a share by its length, at least one. The spline is the
/// natural cubic one, with the distances of the points as parameter.
/// @param points both ends and what lies between, at least two
/// @return `pieces` + 1 points
/// @throws ModelError if two successive points coincide, an arc has not three points or they lie on
/// one line, or `pieces` is less than the number of stretches
std::vector<Eigen::Vector3d> divide_path(BeamPath path, const std::vector<Eigen::Vector3d>& points,
                                         int pieces);

}  // namespace buckens::fem
