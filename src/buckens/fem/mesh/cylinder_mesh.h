// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/fem/mesh/cell_mesh.h"
#include "buckens/fem/mesh/cylinder.h"

namespace buckens::fem {

/// The cells of a round solid with faces `bottom`, `top` and `side`, or `inner` and `outer` with a
/// bore; without a bore also points `bottom_centre`, `top_centre`, `centre`. Lines along the axis
/// are straight, points at half steps are on the true circles.
/// @throws ModelError unless 0 ≤ inner < outer radius, `from` ≠ `to`, divisions ≥ 1 with at least 4
/// around; without a bore those around must be divisible by 4
CellMesh cylinder_cells(const Cylinder& cylinder);

}  // namespace buckens::fem
