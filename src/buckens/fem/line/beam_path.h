// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

namespace buckens::fem {

/// How a beam runs from point to point.
enum class BeamPath { polyline, arc, spline };

constexpr std::array<const char*, 3> choice_names(BeamPath) {
  return {"polyline", "arc", "spline"};
}

/// Divides the path through points into straight pieces whose ends are exactly on it.
///
/// An arc is part of the circle through three points and is divided into equal angles. A polyline
/// and a spline have a node at every given point; the pieces between two of them are equally long,
/// and each stretch gets a number of pieces in proportion to its length, at least one. The spline
/// is the natural cubic one, parametrised by chord length.
/// @param points both ends and what lies between, at least two
/// @return `pieces` + 1 points
/// @throws ModelError if two successive points coincide, an arc does not have three points or they
/// are collinear, or `pieces` is less than the number of stretches
std::vector<Eigen::Vector3d> divide_path(BeamPath path, const std::vector<Eigen::Vector3d>& points,
                                         int pieces);

}  // namespace buckens::fem
