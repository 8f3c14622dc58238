// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/fem/constraint/node_links.h"
#include "buckens/fem/element/block.h"
#include "buckens/fem/element/dof_map.h"

namespace buckens::fem {

/// Displacement and rotation of the reference of an average, as rows over d.
///
/// With all displacements of the nodes these are region_rows(). With selected ones they are the
/// best-fitting rigid motion, Σ w Σ_c (u_ic − u_c − (θ × (x_i − x))_c)² → min over the components c
/// that count at each node. Motions that these components do not determine are not in the rows; for
/// the others, rigid motion of the mesh is followed exactly.
/// @param length size of the mesh [m]: references within 1e-6 of it count as at the centre of the
/// nodes
/// @throws ModelError if the nodes do not determine a variable in which the reference follows
PointRows average_rows(const std::vector<Node>& nodes, const DofMap& dofs, const AverageLink& link,
                       double length);

/// Whether the reference follows in rotation about all axes, and the nodes determine it.
bool gives_rotation(const std::vector<Node>& nodes, const AverageLink& link);

}  // namespace buckens::fem
