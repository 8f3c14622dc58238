// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "buckens/fem/mesh/imported_mesh.h"
#include "buckens/mesh_io/nastran/coordinates.h"

namespace buckens::mesh_io {

/// Which of three translations and three rotations.
using NastranVariables = std::array<bool, 6>;

/// "123" and the like. @throws InputError for other digits
NastranVariables read_nastran_variables(const NastranCard& card, int field);

/// Whether all three, or none, from `first` on are present.
inline bool is_whole(const NastranVariables& v, std::size_t first) {
  return v[first] && v[first + 1] && v[first + 2];
}
inline bool is_without(const NastranVariables& v, std::size_t first) {
  return !v[first] && !v[first + 1] && !v[first + 2];
}

/// Index of the node in a field. @throws InputError if the deck does not have it
int nastran_node(const NastranCard& card, int field, const NastranCoordinates& coordinates);

/// Components refer to the displacement system of the node: individual ones mean the same in mesh
/// axes only if that system is the basic one. @throws InputError otherwise
void check_nastran_axes(const NastranCard& card, const NastranVariables& variables, int node,
                        const NastranCoordinates& coordinates);

/// RBE2, RBAR, RBE1, RTRPLT, CRIGD1 and CRIGD2 become rigid links, RROD an equation.
/// @throws InputError for what cannot be represented exactly
void add_nastran_rigid_elements(const NastranBulk& bulk, const NastranCoordinates& coordinates,
                                NastranNotes& notes, fem::ImportedMesh& mesh);

}  // namespace buckens::mesh_io
