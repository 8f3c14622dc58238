// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "buckens/fem/mesh/cell_kind.h"

namespace buckens::fem {

/// Moments of what an element fills: of a volume ∫dV, ∫x dV, ∫x xᵀ dV; of a surface those over its
/// area, of a line those over its length.
struct CellMeasure {
  double size = 0;                                   ///< [m³, m², m]
  Eigen::Vector3d first = Eigen::Vector3d::Zero();   ///< size times the centre
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  ///< about the origin

  CellMeasure& add(const CellMeasure& other, double factor = 1.0);
};

/// Volumes and surfaces with nodes on their sides exactly, other surfaces and lines by their
/// corners.
/// @param x places of all nodes
CellMeasure cell_measure(CellKind kind, const std::vector<Eigen::Vector3d>& x);

/// How far the shape is from the best, which has 1: of tetrahedra and triangles the longest edge in
/// relation to the radius of the inscribed ball, of others the longest to the shortest edge.
/// Infinite for flat ones. 1 for lines and points.
double aspect_ratio(CellKind kind, const std::vector<Eigen::Vector3d>& x);

/// Whether a volume is turned inside out or flat where it is integrated, see solid_least_volume():
/// no body can be made of it.
bool is_inverted(CellKind kind, const std::vector<Eigen::Vector3d>& x);

/// Whether a volume is turned inside out or flat at one of its nodes; of pyramids at a corner of
/// the base.
bool is_inverted_at_node(CellKind kind, const std::vector<Eigen::Vector3d>& x);

}  // namespace buckens::fem
