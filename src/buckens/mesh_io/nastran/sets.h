// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/fem/mesh/imported_mesh.h"
#include "buckens/mesh_io/nastran/bulk.h"
#include "buckens/mesh_io/nastran/control.h"
#include "buckens/mesh_io/nastran/coordinates.h"
#include "buckens/mesh_io/nastran/names.h"

namespace buckens::mesh_io {

/// Adds the sets of a deck: "SET 5" of the case control, "SET1 5" and "SET3 5" of the bulk data, or
/// the name that a comment gives; and one set of elements per property, under its name.
///
/// SET and SET1 do not tell nodes from elements: nodes with these numbers make a set of nodes,
/// elements with these numbers a set of elements.
/// @param element_ids in the order of the elements in the blocks
/// @throws InputError for fields that are not numbers and for nodes or elements of a SET3 that are
/// not in the deck
void add_nastran_sets(const NastranBulk& bulk, const NastranControl& control,
                      const NastranNames& names, const NastranCoordinates& coordinates,
                      const std::vector<std::int64_t>& element_ids, NastranNotes& notes,
                      fem::ImportedMesh& mesh);

}  // namespace buckens::mesh_io
