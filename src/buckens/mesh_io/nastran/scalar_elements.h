// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/fem/mesh/imported_mesh.h"
#include "buckens/mesh_io/nastran/coordinates.h"

namespace buckens::mesh_io {

/// CELAS1 to CELAS4, CMASS1 to CMASS4 and SPOINT as springs and masses of the body.
///
/// Inside a body, forces must balance in any orientation. So a spring must act in the same
/// direction at both ends; if not along its line, it is placed midway with rigid arms. Scalar
/// points without mass are eliminated: springs in a row become one. Springs to ground are left out,
/// like supports. Masses at a node are used if they are the same in all three directions, as
/// moments of inertia about any axis.
/// @throws InputError for anything without such a meaning
void add_nastran_scalar_elements(const NastranBulk& bulk, NastranCoordinates& coordinates,
                                 NastranNotes& notes, fem::ImportedMesh& mesh);

/// CONM1: a mass matrix, which must be that of a rigid body at the node.
/// @throws InputError if it is not
void add_nastran_mass_matrix(const NastranCard& card, const NastranBulk& bulk,
                             const NastranCoordinates& coordinates, fem::ImportedMesh& mesh);

}  // namespace buckens::mesh_io
