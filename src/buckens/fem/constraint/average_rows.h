// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/fem/constraint/node_links.h"
#include "buckens/fem/element/block.h"
#include "buckens/fem/element/dof_map.h"

namespace buckens::fem {

/// How the reference of an average follows its nodes: displacement and rotation as rows over d.
///
/// With all displacements of the nodes these are region_rows(). With chosen ones they are the rigid
/// motion that fits them best, Σ w Σ_c (u_ic − u_c − (θ × (x_i − x))_c)² → min over the components
/// c that count at each node. Motions that these components leave open are no part of the rows;
/// rigid motion of the mesh is followed exactly by those that they tell.
/// @param length size of the mesh [m]: references within 1e-6 of it are at the centre of the nodes
/// @throws ModelError if the nodes do not tell a variable that the reference has and follows in
PointRows average_rows(const std::vector<Node>& nodes, const DofMap& dofs, const AverageLink& link,
                       double length);

/// Whether the reference follows in rotation about all axes, and the nodes tell it.
bool gives_rotation(const std::vector<Node>& nodes, const AverageLink& link);

}  // namespace buckens::fem
