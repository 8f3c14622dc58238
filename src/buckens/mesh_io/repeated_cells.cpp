// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/repeated_cells.h"

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

#include "buckens/mesh_io/corner_key.h"

namespace buckens::mesh_io {

std::vector<TaggedCells> merged_cells(const TaggedMesh& mesh) {
  struct Place {
    std::size_t cells, element;
  };
  std::unordered_map<CornerKey, Place, CornerHash> first;
  struct Merged {
    std::set<int> groups;
    std::int64_t id;
  };
  std::map<std::pair<std::size_t, std::size_t>, Merged> merged;
  std::vector<std::vector<bool>> repeated(mesh.cells.size());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const TaggedCells& cells = mesh.cells[c];
    repeated[c].resize(cells.ids.size());
    for (std::size_t e = 0; e < cells.ids.size(); ++e) {
      const auto [found, is_new] = first.emplace(corner_key(cells, e), Place{c, e});
      const Place& place = found->second;
      const TaggedCells& other = mesh.cells[place.cells];
      if (is_new || other.kind != cells.kind) continue;
      repeated[c][e] = true;
      Merged& all =
          merged.try_emplace({place.cells, place.element}, Merged{{}, other.ids[place.element]})
              .first->second;
      all.groups.insert(other.groups.begin(), other.groups.end());
      all.groups.insert(cells.groups.begin(), cells.groups.end());
      all.id = std::min(all.id, cells.ids[e]);
    }
  }
  if (merged.empty()) return mesh.cells;
  TaggedMesh out;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const TaggedCells& cells = mesh.cells[c];
    for (std::size_t e = 0; e < cells.ids.size(); ++e) {
      if (repeated[c][e]) continue;
      const auto found = merged.find({c, e});
      std::vector<int> groups = cells.groups;
      if (found != merged.end()) {
        const std::set<int>& all = found->second.groups;
        groups.assign(all.begin(), all.end());
      }
      TaggedCells& target = out.cells_of(cells.kind, cells.source, std::move(groups));
      target.ids.push_back(found == merged.end() ? cells.ids[e] : found->second.id);
      const std::vector<int> nodes = nodes_of(cells, e, fem::num_nodes(cells.kind));
      target.nodes.insert(target.nodes.end(), nodes.begin(), nodes.end());
    }
  }
  return std::move(out.cells);
}

}  // namespace buckens::mesh_io
