// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "buckens/fem/mesh/imported_mesh.h"

namespace buckens::mesh_io {

/// Reads a mesh in the way its file name ends. Lengths, masses and constants stay in the units of
/// the file.
/// @param members groups of surfaces and lines that are elements also where they lie on others, see
/// mesh_of_groups()
/// @throws InputError with file and line where the contents cannot be, IoError if the file cannot
/// be read
fem::ImportedMesh read_mesh_file(const std::filesystem::path& path,
                                 const std::vector<std::string>& members = {});

/// Endings of the files that can be read: ".inp", ".msh" …
std::vector<std::string> mesh_file_endings();

}  // namespace buckens::mesh_io
