// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/fem/mesh/imported_mesh.h"
#include "buckens/fem/mesh/mesh_file_spec.h"

namespace buckens::mesh_io {

/// A model file and what it could not express.
struct MeshModel {
  std::string text;
  std::vector<fem::ImportNote> notes;
};

/// A model file of one free body made of a mesh as gmsh_bytes() writes it: units, materials,
/// sections, point masses, links and springs, which that file cannot hold.
/// @param mesh as read, in units of its file
/// @param mesh_file name under which the mesh was written, relative to the model file
MeshModel model_of_mesh(const fem::ImportedMesh& mesh, const std::string& mesh_file,
                        fem::LengthUnit length, fem::MassUnit mass);

}  // namespace buckens::mesh_io
