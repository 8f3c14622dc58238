// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/fem/mesh/imported_mesh.h"
#include "buckens/mesh_io/nastran/coordinates.h"

namespace buckens::mesh_io {

/// Adds point masses (CONM2) and springs (CBUSH with PBUSH, stiffness only).
///
/// A spring between distant nodes that acts across their line gets its own location with a rigid
/// link to each node, since its forces rotate the nodes; without those links a rotation of the body
/// would stretch it.
/// @throws InputError for missing nodes, systems and properties
void add_nastran_points(const NastranBulk& bulk, NastranCoordinates& coordinates,
                        NastranNotes& notes, fem::ImportedMesh& mesh);

}  // namespace buckens::mesh_io
