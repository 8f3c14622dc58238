// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/mesh_file.h"

#include <algorithm>
#include <cctype>
#include <fstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "buckens/base/errors.h"
#include "buckens/fem/mesh/part_selection.h"
#include "buckens/mesh_io/abaqus/deck.h"
#include "buckens/mesh_io/gmsh/mesh.h"
#include "buckens/mesh_io/nastran/control.h"
#include "buckens/mesh_io/nastran/deck.h"
#include "buckens/mesh_io/skip_list.h"

namespace buckens::mesh_io {

namespace {

struct Format {
  std::string ending;
  fem::ImportedMesh (*read)(const std::filesystem::path&, const fem::MeshWishes&, SkipList&);
};

/// Decks of NASTRAN-95 end in .inp, too. A deck of Abaqus is known by its first star.
bool is_of_nastran(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  constexpr std::streamsize kHead = 1 << 16;
  std::ifstream stream(path, std::ios::binary);
  std::string head(static_cast<std::size_t>(kHead), '\0');
  stream.read(head.data(), kHead);
  head.resize(static_cast<std::size_t>(stream.gcount()));
  const std::size_t first = head.find_first_not_of(" \t\r\n");
  return first != std::string::npos && head[first] != '*' && has_nastran_bulk_data(head);
}

/// Decks define the kind of every element.
fem::ImportedMesh abaqus_deck(const std::filesystem::path& path, const fem::MeshWishes&,
                              SkipList& skip) {
  return is_of_nastran(path) ? read_nastran_deck(path, skip) : read_abaqus_deck(path, skip);
}

fem::ImportedMesh nastran_deck(const std::filesystem::path& path, const fem::MeshWishes&,
                               SkipList& skip) {
  return read_nastran_deck(path, skip);
}

/// A mesh without stiffness and mass of its own: there is nothing to leave out.
fem::ImportedMesh gmsh_mesh(const std::filesystem::path& path, const fem::MeshWishes& wishes,
                            SkipList&) {
  return read_gmsh_mesh(path, wishes.members);
}

const std::vector<Format>& formats() {
  static const std::vector<Format> all = {{".inp", abaqus_deck},  {".msh", gmsh_mesh},
                                          {".unv", gmsh_mesh},    {".bdf", nastran_deck},
                                          {".dat", nastran_deck}, {".nas", nastran_deck},
                                          {".fem", nastran_deck}, {".nastran", nastran_deck}};
  return all;
}

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

std::vector<std::string> mesh_file_endings() {
  std::vector<std::string> out;
  for (const Format& format : formats()) out.push_back(format.ending);
  return out;
}

fem::ImportedMesh read_mesh_file(const std::filesystem::path& path, const fem::MeshWishes& wishes) {
  const std::string ending = lower_case(path.extension().string());
  for (const Format& format : formats()) {
    if (format.ending != ending) continue;
    SkipList skip(wishes.skip);
    fem::ImportedMesh mesh = format.read(path, wishes, skip);
    // First, since the user asked for it.
    const std::vector<fem::ImportNote> skipped = skip.notes();
    mesh.notes.insert(mesh.notes.begin(), skipped.begin(), skipped.end());
    return wishes.only.empty() ? mesh : fem::only_part(mesh, wishes.only);
  }
  throw InputError(
      {path.string(), 0, 0},
      fmt::format("files that end in \"{}\" cannot be read as meshes; known endings are {}", ending,
                  fmt::join(mesh_file_endings(), ", ")));
}

}  // namespace buckens::mesh_io
