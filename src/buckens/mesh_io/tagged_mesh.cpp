// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/tagged_mesh.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "buckens/mesh_io/group_mesh.h"

namespace buckens::mesh_io {

namespace {

constexpr std::array<const char*, 4> kEntity = {"point", "curve", "surface", "volume"};

}  // namespace

TaggedCells& TaggedMesh::cells_of(fem::CellKind kind, const std::string& source,
                                  std::vector<int> groups_of_cells) {
  std::sort(groups_of_cells.begin(), groups_of_cells.end());
  groups_of_cells.erase(std::unique(groups_of_cells.begin(), groups_of_cells.end()),
                        groups_of_cells.end());
  const auto [found, is_new] = places_.emplace(std::make_pair(kind, groups_of_cells), cells.size());
  if (is_new) cells.push_back({kind, source, std::move(groups_of_cells), {}, {}});
  return cells[found->second];
}

int TaggedMesh::group(int dimension, std::int64_t tag) {
  const auto [found, is_new] =
      group_numbers_.emplace(std::make_pair(dimension, tag), static_cast<int>(groups.size()));
  if (is_new) {
    const char* entity = dimension < 0 ? "nodes" : kEntity[static_cast<std::size_t>(dimension)];
    groups.push_back({dimension, tag, fmt::format("{}_{}", entity, tag)});
  }
  return found->second;
}

fem::ImportedMesh mesh_of_groups(TaggedMesh tagged, const std::vector<std::string>& members) {
  return GroupMesh(std::move(tagged), members).made();
}

}  // namespace buckens::mesh_io
