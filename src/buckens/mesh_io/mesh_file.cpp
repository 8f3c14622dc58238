// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/mesh_file.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "buckens/base/errors.h"
#include "buckens/mesh_io/abaqus/deck.h"
#include "buckens/mesh_io/gmsh/mesh.h"
#include "buckens/mesh_io/nastran/deck.h"

namespace buckens::mesh_io {

namespace {

struct Format {
  std::string ending;
  fem::ImportedMesh (*read)(const std::filesystem::path&, const std::vector<std::string>& members);
};

/// Decks say of every element what it is.
template <fem::ImportedMesh (*read)(const std::filesystem::path&)>
fem::ImportedMesh read_deck(const std::filesystem::path& path, const std::vector<std::string>&) {
  return read(path);
}

const std::vector<Format>& formats() {
  static const std::vector<Format> all = {{".inp", read_deck<read_abaqus_deck>},
                                          {".msh", read_gmsh_mesh},
                                          {".unv", read_gmsh_mesh},
                                          {".bdf", read_deck<read_nastran_deck>},
                                          {".dat", read_deck<read_nastran_deck>},
                                          {".nas", read_deck<read_nastran_deck>}};
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

fem::ImportedMesh read_mesh_file(const std::filesystem::path& path,
                                 const std::vector<std::string>& members) {
  const std::string ending = lower_case(path.extension().string());
  for (const Format& format : formats()) {
    if (format.ending == ending) return format.read(path, members);
  }
  throw InputError(
      {path.string(), 0, 0},
      fmt::format("files that end in \"{}\" cannot be read as meshes; known endings are {}", ending,
                  fmt::join(mesh_file_endings(), ", ")));
}

}  // namespace buckens::mesh_io
