// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/fem/mesh/imported_mesh.h"

namespace buckens::fem {

/// A subset of the elements of a mesh, with their nodes.
///
/// Links, springs and equations are kept if they use nodes of these elements only; those that join
/// them to others are left out with a note, since the other side is gone. Point masses are kept on
/// nodes that are kept. Sets keep their remaining members; empty ones are dropped, and so are
/// properties without elements.
/// @param names of element sets or properties; an element belongs to the part if it is in one
/// @throws InputError for a name that is neither, or if no elements remain
ImportedMesh only_part(const ImportedMesh& mesh, const std::vector<std::string>& names);

}  // namespace buckens::fem
