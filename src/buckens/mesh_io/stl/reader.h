// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "buckens/spatial/triangle_list.h"

namespace buckens::mesh_io {

/// Reads the triangles of an STL file, text or binary. STL files state no unit.
/// @param unit length of one unit of the file [m]
/// @throws InputError with file and line (binary: triangle) if the contents are invalid; IoError if
/// it cannot be read
spatial::TriangleList read_stl(const std::filesystem::path& path, double unit);

/// The same from the bytes of a file. @param name in messages
spatial::TriangleList read_stl_bytes(const std::string& bytes, const std::string& name,
                                     double unit);

}  // namespace buckens::mesh_io
