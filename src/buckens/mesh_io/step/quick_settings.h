// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace buckens::mesh_io {

/// Whether a STEP file has so many faces that it must be read with quick settings.
bool has_many_faces(const std::string& step);

/// Writes settings for OpenCASCADE into a directory. With its own it looks in every face for edges
/// and wires that cut themselves and, in files with thousands of faces, spends minutes on that:
/// the time grows with the square of their number. Everything else is mended as always.
void write_quick_settings(const std::filesystem::path& directory);

}  // namespace buckens::mesh_io
