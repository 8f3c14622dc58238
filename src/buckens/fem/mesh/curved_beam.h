// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/fem/line/beam_path.h"
#include "buckens/fem/structure.h"

namespace buckens::fem {

/// Divides the path from one node through given points to another into straight beam elements;
/// creates the unnamed nodes in between.
///
/// Without `up` in the properties, the axes of the first element are those of a straight beam and
/// are transported from element to element by the smallest rotation.
/// @param through points between the nodes, model axes [m]; none: a straight line
/// @throws ModelError as divide_path(), or if a node does not exist
BeamDivision add_curved_beam(Structure& structure, int node_a, int node_b, BeamPath path,
                             const std::vector<Eigen::Vector3d>& through, int divisions,
                             const BeamProperties& properties);

}  // namespace buckens::fem
