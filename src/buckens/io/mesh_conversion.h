// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "buckens/fem/imported_mesh.h"
#include "buckens/fem/mesh_file_spec.h"
#include "buckens/io/vtu_file.h"

namespace buckens::io {

/// The mesh as a grid of VTK: numbers of nodes, elements and properties, and for every set of nodes
/// or elements 1 for its members and 0 for others.
VtuGrid vtu_grid(const fem::ImportedMesh& mesh);

/// A model file of one free body made of a mesh file, with the units, materials and point masses
/// that mesh files of Gmsh do not hold. Comments name what it cannot hold either.
/// @param mesh as it was read, in units of its file
/// @param mesh_file name under which the mesh was written, seen from the model file
std::string model_of_mesh(const fem::ImportedMesh& mesh, const std::string& mesh_file,
                          fem::LengthUnit length, fem::MassUnit mass);

}  // namespace buckens::io
