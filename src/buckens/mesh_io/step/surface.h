// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "buckens/mesh_io/gmsh/library.h"
#include "buckens/mesh_io/step/crossings.h"
#include "buckens/mesh_io/step/walls.h"

namespace buckens::mesh_io {

/// The mesh that the library has of the faces, and of the volumes if they are meshed.
PartMesh part_mesh(const GmshLibrary& gmsh);

struct MendedSurface {
  std::string notes;      ///< on what was done; empty: the mesh of the surface is what it was
  std::string crossings;  ///< where triangles cross in the end; empty: nowhere
};

/// Makes the mesh of the surface again, for volumes that were not meshed because triangles cross:
/// faces on which they fold get a smooth surface.
/// @param metre in units of the mesh
MendedSurface mend_surface(GmshLibrary& gmsh, double metre);

}  // namespace buckens::mesh_io
