// SPDX-License-Identifier: Apache-2.0
// Lines of a mesh of groups: edges, beams by themselves, or beams and bars that hang on elements.
#include "buckens/mesh_io/group_mesh.h"

namespace buckens::mesh_io {

/// Of lines in no group beside other elements: a name, since shells in no group have the section
/// without one. −1 if a group has taken the name.
int GroupMesh::property_of_lines() {
  static constexpr const char kName[] = "lines";
  const auto is_so_called = [](const auto& known) { return known.name == kName; };
  if (std::any_of(tagged_.groups.begin(), tagged_.groups.end(), is_so_called)) return -1;
  const auto known = std::find_if(mesh_.properties.begin(), mesh_.properties.end(), is_so_called);
  if (known != mesh_.properties.end()) return static_cast<int>(known - mesh_.properties.begin());
  fem::ImportedProperty out;
  out.name = kName;
  out.kind = fem::PropertyKind::beam;
  mesh_.properties.push_back(std::move(out));
  return static_cast<int>(mesh_.properties.size()) - 1;
}

/// Lines in no group that are no edges, but that hang on nodes of elements, directly or by way of
/// others: beams and bars whose section the model file has to give. Leaving them out would silently
/// change the stiffness.
TaggedCells GroupMesh::joining_lines(const TaggedCells& cells) const {
  std::vector<bool> is_reached(tagged_.positions.size(), false);
  for (const fem::ImportedBlock& block : mesh_.blocks) {
    if (fem::dimension_of(block.kind) < 2) continue;
    for (const int node : block.nodes) is_reached[static_cast<std::size_t>(node)] = true;
  }
  const int count = fem::num_nodes(cells.kind);
  std::vector<std::size_t> waiting;
  std::map<int, std::vector<std::size_t>> lines_at;
  std::vector<bool> joins(cells.ids.size(), false);
  const auto take = [&](std::size_t e) {
    joins[e] = true;
    waiting.push_back(e);
  };
  for (std::size_t e = 0; e < cells.ids.size(); ++e) {
    if (edges_.at(corner_key(cells, e))) continue;
    bool hangs = false;
    for (const int node : nodes_of(cells, e, count)) {
      hangs = hangs || is_reached[static_cast<std::size_t>(node)];
      lines_at[node].push_back(e);
    }
    if (hangs) take(e);
  }
  while (!waiting.empty()) {
    const std::size_t e = waiting.back();
    waiting.pop_back();
    for (const int node : nodes_of(cells, e, count)) {
      if (is_reached[static_cast<std::size_t>(node)]) continue;
      is_reached[static_cast<std::size_t>(node)] = true;
      for (const std::size_t next : lines_at[node]) {
        if (!joins[next]) take(next);
      }
    }
  }
  TaggedCells out;
  out.kind = cells.kind;
  out.source = cells.source;
  for (std::size_t e = 0; e < cells.ids.size(); ++e) {
    if (!joins[e]) continue;
    out.ids.push_back(cells.ids[e]);
    const std::vector<int> nodes = nodes_of(cells, e, count);
    out.nodes.insert(out.nodes.end(), nodes.begin(), nodes.end());
  }
  return out;
}

void GroupMesh::add_lines() {
  const bool is_alone = mesh_.blocks.empty();
  for (const TaggedCells& cells : tagged_.cells) {
    if (fem::dimension_of(cells.kind) != 1) continue;
    std::size_t edges = 0;
    for (std::size_t e = 0; e < cells.ids.size() && !is_alone; ++e) {
      edges += edges_.at(corner_key(cells, e)) ? 1 : 0;
    }
    const bool is_beam =
        is_alone || (!cells.groups.empty() && edges == 0) || has_member_group(cells);
    if (is_beam) {
      add_elements(cells, fem::PropertyKind::beam);
      continue;
    }
    const TaggedCells joining = cells.groups.empty() ? joining_lines(cells) : TaggedCells();
    if (!joining.ids.empty()) {
      add_elements(joining, fem::PropertyKind::beam);
      mesh_.blocks.back().property = property_of_lines();
      mesh_.notes.push_back(
          {"lines in no group that hang on nodes of other elements are beams or bars; the model "
           "file gives their cross-section: `sections: {lines: …}`",
           0, static_cast<int>(joining.ids.size())});
    }
    note_left_out(cells, cells.ids.size() - edges - joining.ids.size());
  }
}

}  // namespace buckens::mesh_io
