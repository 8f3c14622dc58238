// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "buckens/fem/mesh/imported_mesh.h"
#include "buckens/mesh_io/skip_list.h"

namespace buckens::mesh_io {

/// Reads the mesh of a deck of Abaqus or CalculiX (.inp), in the units of the deck.
///
/// Parts are placed by their instances. Steps, boundary conditions and everything else that is not
/// the body itself are left out and listed in the notes. For the meaning of each keyword see
/// docs/tutorials/meshes-abaqus.md.
/// @param skip keywords and types of elements to leave out; counts those it meets
/// @throws InputError with file and line, also of included files; IoError if the deck itself cannot
/// be read
fem::ImportedMesh read_abaqus_deck(const std::filesystem::path& path, SkipList& skip);
/// The same with nothing left out.
fem::ImportedMesh read_abaqus_deck(const std::filesystem::path& path);

}  // namespace buckens::mesh_io
