// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "buckens/fem/mesh/imported_mesh.h"
#include "buckens/mesh_io/nastran/source.h"
#include "buckens/mesh_io/skip_list.h"

namespace buckens::mesh_io {

/// Reads a deck of Nastran: bulk data in small, large and free field, alone or after executive and
/// case control, with INCLUDE. For the treatment of each card see docs/tutorials/meshes-nastran.md.
///
/// Numbers stay in the units of the deck; densities, masses and inertias are multiplied by
/// PARAM,WTMASS. Nodes of the deck come first, in its order; nodes made for offsets and springs
/// have numbers beyond the largest of the deck.
/// @throws IoError if a file cannot be read
/// @throws InputError with file, line and field for everything that cannot be imported and would
/// change the structure if left out; the rest is listed in ImportedMesh::notes
fem::ImportedMesh read_nastran_deck(const std::filesystem::path& path);
/// The same without the cards to be left out; counts those it meets.
fem::ImportedMesh read_nastran_deck(const std::filesystem::path& path, SkipList& skip);

/// The same from a text, which may contain nodes only; `name` denotes the file in messages, and
/// included files are looked up relative to it.
fem::ImportedMesh read_nastran_text(std::string text, const std::filesystem::path& name,
                                    const LoadNastranFile& load = load_nastran_file);
fem::ImportedMesh read_nastran_text(std::string text, const std::filesystem::path& name,
                                    const LoadNastranFile& load, SkipList& skip);

}  // namespace buckens::mesh_io
