// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "buckens/fem/mesh/imported_mesh.h"
#include "buckens/fem/mesh/mesh_wishes.h"

namespace buckens::mesh_io {

/// Reads a mesh in the format given by its file name. Lengths, masses and constants stay in the
/// units of the file.
/// @throws InputError with file and line if the contents are invalid, or if a wish names something
/// the file does not have; IoError if the file cannot be read
fem::ImportedMesh read_mesh_file(const std::filesystem::path& path,
                                 const fem::MeshWishes& wishes = {});

/// Endings of files that can be read: ".inp", ".msh" …
std::vector<std::string> mesh_file_endings();

}  // namespace buckens::mesh_io
