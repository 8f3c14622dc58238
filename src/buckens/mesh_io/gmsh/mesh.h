// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "buckens/fem/mesh/imported_mesh.h"

namespace buckens::mesh_io {

/// Reads a mesh of Gmsh (.msh 2.2 and 4.1, text and binary) or a universal file (.unv). For groups
/// and `members` see tagged_mesh.h.
/// @param surface what the name of a surface begins with, its number follows; each is then a group
/// of its own in place of the physical groups, of which Gmsh makes each in a time that grows with
/// their number. Version 4 only. Empty: physical groups
/// @throws InputError with file and line if the contents are invalid, IoError if the file cannot be
/// read
fem::ImportedMesh read_gmsh_mesh(const std::filesystem::path& path,
                                 const std::vector<std::string>& members = {},
                                 const std::string& surface = {});

/// The same from the bytes of a file.
/// @param file its name in messages; universal files are recognised by the ending .unv
fem::ImportedMesh read_gmsh_bytes(std::string_view bytes, const std::string& file,
                                  const std::vector<std::string>& members = {},
                                  const std::string& surface = {});

enum class GmshFormat { ascii_2_2, binary_2_2, ascii_4_1, binary_4_1 };

/// What gmsh_bytes() leaves out of the elements and sets of a mesh.
std::vector<fem::ImportNote> losses_in_gmsh(const fem::ImportedMesh& mesh);

/// A mesh in the format of Gmsh: elements with their numbers; properties, element sets and face
/// sets as physical groups; node sets as groups of points, unless a group of the same name has the
/// same nodes. Reading it gives the same mesh. It cannot hold constants, sections, point masses,
/// springs, links and equations; model_of_mesh() does.
/// @throws InputError if there are no elements, or numbers are too large for version 2.2
std::string gmsh_bytes(const fem::ImportedMesh& mesh, GmshFormat format);

}  // namespace buckens::mesh_io
