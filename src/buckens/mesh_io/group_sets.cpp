// SPDX-License-Identifier: Apache-2.0
// Sets of a mesh of groups, and which nodes and numbers it keeps.
#include <algorithm>
#include <iterator>
#include <tuple>
#include <unordered_set>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/mesh_io/group_mesh.h"

namespace buckens::mesh_io {

void GroupMesh::add_sets() {
  std::map<std::string, std::size_t> known;
  for (auto& [number, elements] : element_sets_) {
    const auto [found, is_new] = known.emplace(group(number).name, mesh_.element_sets.size());
    if (is_new) mesh_.element_sets.push_back({group(number).name, {}});
    std::vector<int>& all = mesh_.element_sets[found->second].elements;
    all.insert(all.end(), elements.begin(), elements.end());
    std::sort(all.begin(), all.end());
  }
  known.clear();
  for (auto& [number, faces] : faces_) {
    const auto [found, is_new] = known.emplace(group(number).name, mesh_.face_sets.size());
    if (is_new) mesh_.face_sets.push_back({group(number).name, {}});
    std::vector<fem::ImportedFace>& all = mesh_.face_sets[found->second].faces;
    all.insert(all.end(), faces.begin(), faces.end());
  }
  for (fem::ImportedFaceSet& set : mesh_.face_sets) {
    std::sort(set.faces.begin(), set.faces.end(), [](const auto& a, const auto& b) {
      return std::tie(a.element, a.corners) < std::tie(b.element, b.corners);
    });
  }
}

/// Groups of points come first: if groups of several dimensions have the same name, the set has the
/// nodes of the most specific one.
void GroupMesh::add_node_sets() {
  std::map<std::pair<int, int>, std::vector<int>> nodes;  // by dimension and group
  for (const TaggedCells& cells : tagged_.cells) {
    for (const int number : cells.groups) {
      auto& own = nodes[{group(number).dimension, number}];
      own.insert(own.end(), cells.nodes.begin(), cells.nodes.end());
    }
  }
  for (const auto& [number, members] : tagged_.group_nodes) {
    auto& own = nodes[{group(number).dimension, number}];
    own.insert(own.end(), members.begin(), members.end());
  }
  struct Known {
    int dimension;
    std::size_t set;
  };
  std::map<std::string, Known> known;
  for (const auto& [key, own] : nodes) {
    const std::string& name = group(key.second).name;
    const auto [found, is_new] = known.emplace(name, Known{key.first, mesh_.node_sets.size()});
    if (found->second.dimension != key.first) continue;
    if (is_new) mesh_.node_sets.push_back({name, {}});
    std::vector<int>& all = mesh_.node_sets[found->second.set].nodes;
    all.insert(all.end(), own.begin(), own.end());
  }
  for (fem::ImportedNodeSet& set : mesh_.node_sets) {
    std::sort(set.nodes.begin(), set.nodes.end());
    set.nodes.erase(std::unique(set.nodes.begin(), set.nodes.end()), set.nodes.end());
  }
}

/// Removes nodes that were only in the middle of faces and volumes.
void GroupMesh::drop_nodes() {
  if (tagged_.dropped_nodes.empty()) return;
  std::vector<int> number(mesh_.positions.size(), 0);
  for (const int node : tagged_.dropped_nodes) number[static_cast<std::size_t>(node)] = -1;
  for (const TaggedCells& cells : tagged_.cells) {
    for (const int node : cells.nodes) number[static_cast<std::size_t>(node)] = 0;
  }
  for (const auto& [group, nodes] : tagged_.group_nodes) {
    for (const int node : nodes) number[static_cast<std::size_t>(node)] = 0;
  }
  int kept = 0;
  for (std::size_t node = 0; node < number.size(); ++node) {
    if (number[node] < 0) continue;
    mesh_.positions[static_cast<std::size_t>(kept)] = mesh_.positions[node];
    mesh_.node_ids[static_cast<std::size_t>(kept)] = mesh_.node_ids[node];
    number[node] = kept++;
  }
  mesh_.notes.push_back(
      {"nodes in the middle of faces and volumes are left out: hexahedra with 27 "
       "nodes become hex20, prisms with 18 wedge15, quadrangles with 9 quad8",
       0, static_cast<int>(number.size()) - kept});
  mesh_.positions.resize(static_cast<std::size_t>(kept));
  mesh_.node_ids.resize(static_cast<std::size_t>(kept));
  const auto renumber = [&](std::vector<int>& nodes) {
    for (int& node : nodes) node = number[static_cast<std::size_t>(node)];
  };
  for (fem::ImportedBlock& block : mesh_.blocks) renumber(block.nodes);
  for (fem::ImportedNodeSet& set : mesh_.node_sets) renumber(set.nodes);
  for (fem::ImportedFaceSet& set : mesh_.face_sets) {
    for (fem::ImportedFace& face : set.faces) renumber(face.corners);
  }
}

void GroupMesh::check_numbers() const {
  std::unordered_set<std::int64_t> seen;
  for (const fem::ImportedBlock& block : mesh_.blocks) {
    for (const std::int64_t id : block.ids) {
      if (seen.insert(id).second) continue;
      throw InputError({mesh_.file, 0, 0},
                       fmt::format("two elements have the number {}; renumber them in Gmsh "
                                   "(Mesh.Renumber), or save the mesh again",
                                   id));
    }
  }
}

}  // namespace buckens::mesh_io
