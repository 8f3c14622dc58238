// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/mesh_io/gmsh/library.h"

namespace buckens::mesh_io {

/// The faces on which Gmsh could make triangles only that lie on each other: the parameters of
/// their surface fold at an edge.
std::vector<int> folded_faces(const GmshLibrary& gmsh);

/// Puts smooth faces through the edges of such faces, and through some of their points if they
/// bulge, in their place, under the same numbers. Takes the mesh away.
/// @param metre in units of the mesh
/// @return a note; empty if nothing was changed
/// @throws IoError if their area or the volume would change by that
std::string smooth_folded_faces(GmshLibrary& gmsh, const std::vector<int>& faces, double metre);

/// Whether a trial failed because no smooth face could take the place of one that folds.
bool is_stopped_by_fold(const std::string& outcome);

}  // namespace buckens::mesh_io
