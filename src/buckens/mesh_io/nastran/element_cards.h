// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/mesh_io/nastran/bulk.h"

namespace buckens::mesh_io {

/// Adds an element to the bulk data if the card is one of those in NastranElementKind.
///
/// Solids have either their corners or all nodes. CTRIAR and CQUADR are treated as CTRIA3 and
/// CQUAD4, elements of NASTRAN-95 as their successors.
/// @return false if it is another card
/// @throws InputError for missing or repeated nodes
bool read_element_card(const NastranCard& card, NastranBulk& bulk, NastranNotes& notes);

/// Reads BAROR or BEAMOR.
void read_nastran_line_defaults(const NastranCard& card, NastranBulk& bulk);

}  // namespace buckens::mesh_io
