// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "buckens/body/body.h"
#include "buckens/model/build/structure_from_spec.h"
#include "buckens/model/whole_body.h"

namespace buckens::model {

/// Eliminates the nodal variables that rigid interfaces and the links inside a mesh make dependent.
/// For a body with several frames the mesh is that of one part, and a rigid interface lies within
/// one part.
/// @param notes gets one on nodes that nothing holds
/// @throws ModelError if there are links and the body has geometric stiffness
void eliminate_links(const NamedStructure& mesh, body::Body& body, std::vector<std::string>& notes);

/// A divided body as it would be in one frame, with its rigid interfaces eliminated: for its
/// vibrations.
std::unique_ptr<body::FlexiblePart> undivided_part(const WholeBody& whole,
                                                   const body::CouplingChoice& coupling);

}  // namespace buckens::model
