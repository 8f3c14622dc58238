// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "buckens/fem/imported_mesh.h"

namespace buckens::io {

/// Reads a mesh in the way its file name ends. Lengths, masses and constants stay in the units of
/// the file.
/// @throws InputError with file and line where the contents cannot be, IoError if the file cannot
/// be
///         read
fem::ImportedMesh read_mesh_file(const std::filesystem::path& path);

/// Endings of the files that can be read: ".inp", ".msh" …
std::vector<std::string> mesh_file_endings();

}  // namespace buckens::io
