// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "buckens/fem/cell_faces.h"
#include "buckens/io/gmsh_elements.h"
#include "buckens/io/tagged_mesh.h"

namespace buckens::io {

using fem::CellKind;
using fem::ImportedMesh;

namespace {

/// Elements of all blocks by their number through all of them.
struct ElementPlace {
  const fem::ImportedBlock* block;
  int element;

  const int* nodes() const {
    return block->nodes.data() + static_cast<std::ptrdiff_t>(element) * fem::num_nodes(block->kind);
  }
};

class MeshGroups {
 public:
  explicit MeshGroups(const ImportedMesh& mesh) : mesh_(mesh) {
    for (const fem::ImportedBlock& block : mesh.blocks) {
      for (int e = 0; e < block.num_elements(); ++e) places_.push_back({&block, e});
      for (const std::int64_t id : block.ids) last_id_ = std::max(last_id_, id);
    }
  }

  TaggedMesh made() &&;

 private:
  int group(int dimension, const std::string& name);
  void add_elements();
  void add_faces();
  void add_node_sets();
  void note_losses();
  /// The nodes of the face with these corners; empty if the element has no such face.
  static std::vector<int> face_nodes(const ElementPlace& place, const std::vector<int>& corners);

  const ImportedMesh& mesh_;
  TaggedMesh out_;
  std::vector<ElementPlace> places_;
  std::int64_t last_id_ = 0;
};

int MeshGroups::group(int dimension, const std::string& name) {
  for (std::size_t i = 0; i < out_.groups.size(); ++i) {
    if (out_.groups[i].dimension == dimension && out_.groups[i].name == name) {
      return static_cast<int>(i);
    }
  }
  const auto tag = static_cast<std::int64_t>(out_.groups.size()) + 1;
  out_.groups.push_back({dimension, tag, name});
  return static_cast<int>(out_.groups.size()) - 1;
}

void MeshGroups::add_elements() {
  std::vector<std::vector<int>> groups(places_.size());
  for (std::size_t e = 0; e < places_.size(); ++e) {
    const fem::ImportedBlock& block = *places_[e].block;
    if (block.property < 0) continue;
    groups[e].push_back(group(fem::dimension_of(block.kind),
                              mesh_.properties[static_cast<std::size_t>(block.property)].name));
  }
  for (const fem::ImportedElementSet& set : mesh_.element_sets) {
    for (const int element : set.elements) {
      const auto e = static_cast<std::size_t>(element);
      groups[e].push_back(group(fem::dimension_of(places_[e].block->kind), set.name));
    }
  }
  for (std::size_t e = 0; e < places_.size(); ++e) {
    const ElementPlace& place = places_[e];
    const CellKind kind = place.block->kind;
    TaggedCells& cells = out_.cells_of(kind, gmsh_element(kind).name, groups[e]);
    cells.ids.push_back(place.block->ids[static_cast<std::size_t>(place.element)]);
    cells.nodes.insert(cells.nodes.end(), place.nodes(), place.nodes() + fem::num_nodes(kind));
  }
}

std::vector<int> MeshGroups::face_nodes(const ElementPlace& place,
                                        const std::vector<int>& corners) {
  const CellKind kind = place.block->kind;
  const std::set<int> wanted(corners.begin(), corners.end());
  for (const fem::CellFace& face : fem::cell_faces(kind)) {
    const auto count = static_cast<std::size_t>(fem::num_corners(face));
    std::vector<int> out;
    for (std::size_t k = 0; k < count; ++k) out.push_back(place.nodes()[face[k]]);
    if (std::set<int>(out.begin(), out.end()) != wanted) continue;
    if (fem::num_nodes(kind) == fem::num_corners(kind)) return out;
    const auto edges = fem::cell_edges(kind);
    for (std::size_t k = 0; k < count; ++k) {
      const int a = face[k], b = face[(k + 1) % count];
      const auto edge = std::find_if(edges.begin(), edges.end(), [&](const auto& e) {
        return (e[0] == a && e[1] == b) || (e[0] == b && e[1] == a);
      });
      out.push_back(place.nodes()[fem::num_corners(kind) + (edge - edges.begin())]);
    }
    return out;
  }
  return {};
}

CellKind kind_of_face(std::size_t nodes) {
  switch (nodes) {
    case 3:
      return CellKind::tri3;
    case 4:
      return CellKind::quad4;
    case 6:
      return CellKind::tri6;
    default:
      return CellKind::quad8;
  }
}

void MeshGroups::add_faces() {
  struct Surface {
    std::vector<int> nodes, groups;
  };
  std::map<std::vector<int>, std::size_t> known;  // by sorted nodes
  std::vector<Surface> surfaces;
  int of_shells = 0;
  for (const fem::ImportedFaceSet& set : mesh_.face_sets) {
    for (const fem::ImportedFace& face : set.faces) {
      const ElementPlace& place = places_[static_cast<std::size_t>(face.element)];
      const std::vector<int> nodes = face_nodes(place, face.corners);
      if (fem::dimension_of(place.block->kind) != 3 || nodes.empty()) {
        ++of_shells;
        continue;
      }
      std::vector<int> key = nodes;
      std::sort(key.begin(), key.end());
      const auto [found, is_new] = known.emplace(std::move(key), surfaces.size());
      if (is_new) surfaces.push_back({nodes, {}});
      surfaces[found->second].groups.push_back(group(2, set.name));
    }
  }
  for (const Surface& surface : surfaces) {
    const CellKind kind = kind_of_face(surface.nodes.size());
    TaggedCells& cells = out_.cells_of(kind, gmsh_element(kind).name, surface.groups);
    cells.ids.push_back(++last_id_);
    cells.nodes.insert(cells.nodes.end(), surface.nodes.begin(), surface.nodes.end());
  }
  if (of_shells > 0) {
    out_.notes.push_back(
        {"faces of shells have no place in a mesh of Gmsh and are left out", 0, of_shells});
  }
}

void MeshGroups::add_node_sets() {
  std::map<std::string, std::set<int>> nodes_of_groups;
  for (const TaggedCells& cells : out_.cells) {
    for (const int number : cells.groups) {
      auto& nodes = nodes_of_groups[out_.groups[static_cast<std::size_t>(number)].name];
      nodes.insert(cells.nodes.begin(), cells.nodes.end());
    }
  }
  std::map<int, std::vector<int>> groups;  // by node
  for (const fem::ImportedNodeSet& set : mesh_.node_sets) {
    const auto found = nodes_of_groups.find(set.name);
    if (found != nodes_of_groups.end() &&
        found->second == std::set<int>(set.nodes.begin(), set.nodes.end())) {
      continue;
    }
    const int number = group(0, set.name);
    for (const int node : set.nodes) groups[node].push_back(number);
  }
  for (const auto& [node, own] : groups) {
    TaggedCells& cells = out_.cells_of(CellKind::point1, "point", own);
    cells.ids.push_back(++last_id_);
    cells.nodes.push_back(node);
  }
}

void MeshGroups::note_losses() {
  const auto note = [&](const char* what, std::size_t count) {
    if (count == 0) return;
    out_.notes.push_back({fmt::format("{} have no place in a mesh of Gmsh and are left out", what),
                          0, static_cast<int>(count)});
  };
  note("point masses", mesh_.masses.size());
  note("springs", mesh_.springs.size());
  note("rigid links", mesh_.rigid_links.size());
  note("nodes that follow a mean motion", mesh_.averages.size());
  note("equations between nodes", mesh_.equations.size());
}

TaggedMesh MeshGroups::made() && {
  out_.file = mesh_.file;
  out_.format = mesh_.format;
  out_.node_ids = mesh_.node_ids;
  out_.positions = mesh_.positions;
  for (const fem::ImportedProperty& property : mesh_.properties) {
    for (const fem::ImportedBlock& block : mesh_.blocks) {
      const auto index = static_cast<int>(&property - mesh_.properties.data());
      if (block.property == index) group(fem::dimension_of(block.kind), property.name);
    }
  }
  add_elements();
  add_faces();
  add_node_sets();
  note_losses();
  return std::move(out_);
}

}  // namespace

TaggedMesh groups_of_mesh(const ImportedMesh& mesh) { return MeshGroups(mesh).made(); }

}  // namespace buckens::io
