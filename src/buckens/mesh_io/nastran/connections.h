// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "buckens/fem/mesh/imported_mesh.h"
#include "buckens/mesh_io/nastran/coordinates.h"

namespace buckens::mesh_io {

/// Adds connections between nodes: RBE2 and RBAR as rigid links, RBE3 as averages, MPC as equations
/// in mesh axes.
/// @param mpc_set of the case control; without it all sets apply, or those of one MPCADD
/// @throws InputError for what cannot be represented exactly
void add_nastran_connections(const NastranBulk& bulk, bool has_control,
                             const std::optional<std::int64_t>& mpc_set,
                             const NastranCoordinates& coordinates, NastranNotes& notes,
                             fem::ImportedMesh& mesh);

}  // namespace buckens::mesh_io
