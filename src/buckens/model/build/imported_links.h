// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/base/source_location.h"
#include "buckens/fem/mesh/imported_mesh.h"
#include "buckens/fem/mesh/mesh_file_spec.h"
#include "buckens/fem/structure.h"

namespace buckens::model {

/// Marks the nodes that links and springs of a mesh file use.
/// @param used one entry per node of the file
void mark_linked_nodes(const fem::ImportedMesh& mesh, std::vector<bool>& used);

/// Marks the nodes that point masses and links of the model file use; names that are not in the
/// file are left to the code that adds them.
void mark_given_nodes(const fem::ImportedMesh& mesh, const fem::GroupMaterials& given,
                      std::vector<bool>& used);

/// Adds rigid links, averages, equations, springs and point masses of a mesh file. A mass with an
/// offset gets a node of its own, linked rigidly.
/// @param numbers node of the structure per node of the file
/// @param where the body in the model file, for messages
/// @return notes on what became of springs, see add_node_springs()
/// @throws InputError for a spring to ground or an average without nodes
std::vector<std::string> add_imported_links(const fem::ImportedMesh& mesh,
                                            const std::vector<int>& numbers,
                                            const SourceLocation& where, fem::Structure& structure);

}  // namespace buckens::model
