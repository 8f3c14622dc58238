// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/body/body.h"
#include "buckens/model/structure_from_spec.h"

namespace buckens::model {

/// Eliminates the nodal variables that rigid interfaces and the links inside a mesh make dependent.
/// @param is_divided the mesh belongs to a body with several frames
/// @throws ModelError if there are links and the body has several frames or geometric stiffness
void eliminate_links(const NamedStructure& mesh, bool is_divided, body::Body& body);

}  // namespace buckens::model
