// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "buckens/fem/mesh/imported_mesh.h"
#include "buckens/mesh_io/nastran/source.h"
#include "buckens/mesh_io/skip_list.h"

namespace buckens::mesh_io {

/// Reads a deck of Nastran: bulk data in small, large and free field, alone or after executive and
/// case control, with INCLUDE. What becomes of which card: docs/tutorials/meshes-nastran.md.
///
/// Numbers stay in the units of the deck; densities, masses and inertias are multiplied by
/// PARAM,WTMASS. Nodes of the deck come first, in its order; nodes made for offsets and springs
/// have numbers beyond the largest of the deck.
/// @throws IoError if a file cannot be read
/// @throws InputError with file, line and field for everything that cannot be taken over and would
/// make another structure if it were left out; the rest stands in ImportedMesh::notes
fem::ImportedMesh read_nastran_deck(const std::filesystem::path& path);
/// The same without the cards that are to be left out; counts those it meets.
fem::ImportedMesh read_nastran_deck(const std::filesystem::path& path, SkipList& skip);

/// The same from a text, which may hold nodes alone; `name` stands for the file in messages and
/// beside it included files are looked for.
fem::ImportedMesh read_nastran_text(std::string text, const std::filesystem::path& name,
                                    const LoadNastranFile& load = load_nastran_file);
fem::ImportedMesh read_nastran_text(std::string text, const std::filesystem::path& name,
                                    const LoadNastranFile& load, SkipList& skip);

}  // namespace buckens::mesh_io
