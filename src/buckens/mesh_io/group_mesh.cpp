// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/group_mesh.h"

#include <fmt/format.h>

#include "buckens/fem/mesh/cell_faces.h"
#include "buckens/mesh_io/repeated_cells.h"

namespace buckens::mesh_io {

int GroupMesh::property(int number, fem::PropertyKind kind) {
  const auto [found, is_new] =
      properties_.emplace(number, static_cast<int>(mesh_.properties.size()));
  if (is_new) {
    fem::ImportedProperty out;
    out.name = group(number).name;
    out.kind = kind;
    mesh_.properties.push_back(std::move(out));
  }
  return found->second;
}

void GroupMesh::add_elements(const TaggedCells& cells, fem::PropertyKind kind) {
  fem::ImportedBlock block;
  block.kind = cells.kind;
  block.source = cells.source;
  block.ids = cells.ids;
  block.nodes = cells.nodes;
  if (!cells.groups.empty()) block.property = property(cells.groups.front(), kind);
  const int first = mesh_.num_elements();
  for (const int number : cells.groups) {
    auto& elements = element_sets_[number];
    for (int e = 0; e < block.num_elements(); ++e) elements.push_back(first + e);
  }
  find_sides(cells, first);
  find_edges(cells);
  mesh_.blocks.push_back(std::move(block));
}

void GroupMesh::list_surfaces_and_lines() {
  for (const TaggedCells& cells : tagged_.cells) {
    const int dimension = fem::dimension_of(cells.kind);
    for (std::size_t e = 0; e < cells.ids.size(); ++e) {
      if (dimension == 2) sides_.try_emplace(corner_key(cells, e));
      if (dimension == 1) edges_.try_emplace(corner_key(cells, e), false);
    }
  }
}

/// Which of the surfaces are faces of these volumes.
void GroupMesh::find_sides(const TaggedCells& cells, int first) {
  if (sides_.empty() || fem::dimension_of(cells.kind) != 3) return;
  for (std::size_t e = 0; e < cells.ids.size(); ++e) {
    const std::vector<int> nodes = nodes_of(cells, e, fem::num_corners(cells.kind));
    for (const fem::CellFace& face : fem::cell_faces(cells.kind)) {
      Side side{first + static_cast<int>(e), {-1, -1, -1, -1}};
      for (int k = 0; k < fem::num_corners(face); ++k) {
        const auto corner = static_cast<std::size_t>(k);
        side.corners[corner] = nodes[static_cast<std::size_t>(face[corner])];
      }
      const auto found = sides_.find(corner_key(side.corners));
      if (found != sides_.end() && found->second.element < 0) found->second = side;
    }
  }
}

/// Which of the lines are edges of these elements.
void GroupMesh::find_edges(const TaggedCells& cells) {
  if (edges_.empty() || fem::dimension_of(cells.kind) < 2) return;
  for (std::size_t e = 0; e < cells.ids.size(); ++e) {
    const std::vector<int> nodes = nodes_of(cells, e, fem::num_corners(cells.kind));
    for (const auto& [a, b] : fem::cell_edges(cells.kind)) {
      const auto found = edges_.find(corner_key(std::array<int, 2>{
          nodes[static_cast<std::size_t>(a)], nodes[static_cast<std::size_t>(b)]}));
      if (found != edges_.end()) found->second = true;
    }
  }
}

void GroupMesh::add_volumes() {
  for (const TaggedCells& cells : tagged_.cells) {
    if (fem::dimension_of(cells.kind) == 3) add_elements(cells, fem::PropertyKind::solid);
  }
}

void GroupMesh::note_left_out(const TaggedCells& cells, std::size_t count) {
  if (count == 0) return;
  const std::string where =
      cells.groups.empty() ? "without a group"
                           : fmt::format("of the group \"{}\"", group(cells.groups.front()).name);
  mesh_.notes.push_back({fmt::format("elements {} ({}) that lie on no other element are left out",
                                     where, cells.source),
                         0, static_cast<int>(count)});
}

/// The sides of shells from which their nodes run counter-clockwise.
void GroupMesh::add_shell_sides(const TaggedCells& cells, int first) {
  const int corners = fem::num_corners(cells.kind);
  for (std::size_t e = 0; e < cells.ids.size(); ++e) {
    const fem::ImportedFace face{first + static_cast<int>(e), nodes_of(cells, e, corners)};
    for (const int number : cells.groups) faces_[number].push_back(face);
  }
}

void GroupMesh::add_sides(const TaggedCells& cells, bool is_shell) {
  std::size_t missing = 0;
  for (std::size_t e = 0; e < cells.ids.size(); ++e) {
    const Side& side = sides_.at(corner_key(cells, e));
    if (side.element < 0) {
      ++missing;
      continue;
    }
    const auto& corners = side.corners;
    fem::ImportedFace face{side.element,
                           {corners.begin(), corners.end() - (corners[3] < 0 ? 1 : 0)}};
    for (const int number : cells.groups) faces_[number].push_back(face);
  }
  if (!is_shell) note_left_out(cells, missing);
}

void GroupMesh::add_surfaces() {
  const bool has_volumes = !mesh_.blocks.empty();
  // A group that touches no volume at all is a shell of its own.
  std::map<int, bool> touches;
  for (const TaggedCells& cells : tagged_.cells) {
    if (fem::dimension_of(cells.kind) != 2 || cells.groups.empty() || !has_volumes) continue;
    for (std::size_t e = 0; e < cells.ids.size(); ++e) {
      if (sides_.at(corner_key(cells, e)).element < 0) continue;
      for (const int number : cells.groups) touches[number] = true;
      break;
    }
  }
  for (const TaggedCells& cells : tagged_.cells) {
    if (fem::dimension_of(cells.kind) != 2) continue;
    const bool is_apart =
        !has_volumes || (!cells.groups.empty() &&
                         std::none_of(cells.groups.begin(), cells.groups.end(),
                                      [&](int number) { return touches.count(number) > 0; }));
    const int first = mesh_.num_elements();
    const bool is_shell = is_apart || has_member_group(cells);
    if (is_shell) add_elements(cells, fem::PropertyKind::shell);
    if (is_apart) {
      add_shell_sides(cells, first);
    } else {
      add_sides(cells, is_shell);
    }
  }
}

fem::ImportedMesh GroupMesh::made() && {
  mesh_.file = tagged_.file;
  mesh_.format = tagged_.format;
  mesh_.notes = tagged_.notes;
  if (tagged_.repeats_elements) tagged_.cells = merged_cells(tagged_);
  list_surfaces_and_lines();
  add_volumes();
  add_surfaces();
  add_lines();
  mesh_.positions = std::move(tagged_.positions);
  mesh_.node_ids = std::move(tagged_.node_ids);
  add_sets();
  add_node_sets();
  drop_nodes();
  check_numbers();
  return std::move(mesh_);
}

}  // namespace buckens::mesh_io
