// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/fem/mesh/imported_mesh.h"

namespace buckens::fem {

/// Some of the elements of a mesh, with their nodes.
///
/// Links, springs and equations stay where they use nodes of these elements and none of the others;
/// those that join both are left out with a note, as nothing is there any more to join. Point
/// masses stay on nodes that stay. Sets keep what stays of them; those without anything are
/// dropped, and so are properties that no element has.
/// @param names of element sets or properties; an element belongs to the part if it is in one
/// @throws InputError for a name that is neither, or if no elements remain
ImportedMesh only_part(const ImportedMesh& mesh, const std::vector<std::string>& names);

}  // namespace buckens::fem
