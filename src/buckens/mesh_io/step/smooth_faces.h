// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/mesh_io/gmsh/library.h"

namespace buckens::mesh_io {

/// The faces on which Gmsh could make triangles only that lie on each other: the parameters of
/// their surface fold at an edge.
std::vector<int> folded_faces(const GmshLibrary& gmsh);

/// Puts smooth faces through the edges of such faces in their place, under the same numbers, unless
/// their area or the volume changed by that. Takes the mesh away.
/// @return a note; empty if nothing was changed
std::string smooth_folded_faces(GmshLibrary& gmsh, const std::vector<int>& faces);

}  // namespace buckens::mesh_io
