// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/fem/mesh/imported_mesh.h"
#include "buckens/mesh_io/nastran/coordinates.h"
#include "buckens/mesh_io/nastran/nonstructural_mass.h"
#include "buckens/mesh_io/nastran/properties.h"

namespace buckens::mesh_io {

/// Puts the elements of a deck into blocks: one per shape, card and property.
///
/// Mid-side nodes come in the order of fem::CellKind: Nastran lists vertical edges before upper
/// ones. Those that are left out get a node all the same, see NastranMidsides. Ends of beams with
/// offsets become separate nodes, held by rigid links. Non-structural mass becomes point masses
/// at the nodes.
/// @return numbers of the elements, in the order in which blocks count them
/// @throws InputError for missing nodes, properties and materials, and for numbers used twice
std::vector<std::int64_t> add_nastran_elements(const NastranBulk& bulk,
                                               NastranCoordinates& coordinates,
                                               NastranProperties& properties,
                                               NastranNonstructuralMass& nonstructural,
                                               NastranNotes& notes, fem::ImportedMesh& mesh);

}  // namespace buckens::mesh_io
