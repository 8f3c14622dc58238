// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "buckens/fem/mesh/mesh_file_spec.h"
#include "buckens/fem/structure.h"

namespace buckens::model {

/// Nodes and elements made from a mesh file.
struct ImportedStructure {
  fem::Structure structure;
  std::unordered_map<std::int64_t, int> numbers;  ///< nodes by their number in the file
  std::vector<std::string> notes;                 ///< on what was taken otherwise than written
};

/// Gives every element of a mesh file its material, section and thickness. Unused nodes are left
/// out.
/// @param mesh in SI units
/// @param damping of the whole body; overrides that of the materials
/// @param where the body in the model file, for messages
/// @throws InputError if a material or a section is missing, or a name is unknown
ImportedStructure imported_structure(const fem::ImportedMesh& mesh,
                                     const fem::GroupMaterials& materials,
                                     const std::optional<fem::DampingSpec>& damping,
                                     const SourceLocation& where);

}  // namespace buckens::model
