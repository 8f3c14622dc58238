// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "buckens/fem/mesh/imported_mesh.h"
#include "buckens/mesh_io/corner_key.h"
#include "buckens/mesh_io/tagged_mesh.h"

namespace buckens::mesh_io {

/// Builds the mesh of elements and sets out of a tagged mesh.
class GroupMesh {
 public:
  GroupMesh(TaggedMesh tagged, const std::vector<std::string>& members)
      : tagged_(std::move(tagged)), members_(members.begin(), members.end()) {}

  fem::ImportedMesh made() &&;

 private:
  /// Where a surface lies on a volume.
  struct Side {
    int element = -1;  // −1: nowhere
    std::array<int, 4> corners = {-1, -1, -1, -1};
  };

  void add_elements(const TaggedCells& cells, fem::PropertyKind kind);
  void list_surfaces_and_lines();
  void find_sides(const TaggedCells& cells, int first);
  void find_edges(const TaggedCells& cells);
  void add_volumes();
  void add_surfaces();
  void add_lines();
  TaggedCells joining_lines(const TaggedCells& cells) const;
  void add_sides(const TaggedCells& cells, bool is_shell);
  void add_shell_sides(const TaggedCells& cells, int first);
  void note_left_out(const TaggedCells& cells, std::size_t count);
  void add_sets();
  void add_node_sets();
  void drop_nodes();
  void check_numbers() const;
  int property(int group, fem::PropertyKind kind);
  int property_of_lines();
  const CellGroup& group(int number) const {
    return tagged_.groups[static_cast<std::size_t>(number)];
  }
  bool has_member_group(const TaggedCells& cells) const {
    return std::any_of(cells.groups.begin(), cells.groups.end(),
                       [&](int number) { return members_.contains(group(number).name); });
  }

  TaggedMesh tagged_;
  std::set<std::string> members_;  // groups that always become elements
  fem::ImportedMesh mesh_;
  std::unordered_map<CornerKey, Side, CornerHash> sides_;  // of all surfaces
  std::unordered_map<CornerKey, bool, CornerHash> edges_;  // all lines: whether they are edges
  std::map<int, int> properties_;                          // by group
  std::map<int, std::vector<int>> element_sets_;           // by group
  std::map<int, std::vector<fem::ImportedFace>> faces_;    // by group
};

}  // namespace buckens::mesh_io
