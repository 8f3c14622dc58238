// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "buckens/fem/mesh/cell_kind.h"

namespace buckens::fem {

/// Moments of the extent of an element: of a volume ∫dV, ∫x dV, ∫x xᵀ dV; of a surface over its
/// area, of a line over its length.
struct CellMeasure {
  double size = 0;                                   ///< [m³, m², m]
  Eigen::Vector3d first = Eigen::Vector3d::Zero();   ///< size times the centre
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  ///< about the origin

  CellMeasure& add(const CellMeasure& other, double factor = 1.0);
};

/// Exact for volumes and for surfaces with nodes on their sides; other surfaces and lines by their
/// corners.
/// @param x positions of all nodes
CellMeasure cell_measure(CellKind kind, const std::vector<Eigen::Vector3d>& x);

/// Aspect ratio, 1 for the best shape: for tetrahedra and triangles the longest edge relative to
/// the radius of the inscribed ball, for others the longest to the shortest edge. Infinite for flat
/// ones. 1 for lines and points.
double aspect_ratio(CellKind kind, const std::vector<Eigen::Vector3d>& x);

/// Whether a volume is inverted or flat where it is integrated, see solid_least_volume(): no body
/// can be made of it.
bool is_inverted(CellKind kind, const std::vector<Eigen::Vector3d>& x);

/// Whether a volume is inverted or flat at one of its nodes; for pyramids, at a corner of the
/// base.
bool is_inverted_at_node(CellKind kind, const std::vector<Eigen::Vector3d>& x);

}  // namespace buckens::fem
