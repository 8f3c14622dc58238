// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <unordered_set>

#include <fmt/format.h>

#include "buckens/base/field.h"
#include "buckens/fem/mesh/cell_faces.h"
#include "buckens/mesh_io/gmsh/elements.h"
#include "buckens/mesh_io/tagged_mesh.h"

namespace buckens::mesh_io {

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
  bool is_group_of_shells(const fem::ImportedFaceSet& set) const;
  void add_node_sets();
  /// The nodes of the face with these corners; empty if the element has no such face.
  static std::vector<int> face_nodes(const ElementPlace& place, const std::vector<int>& corners);

  const ImportedMesh& mesh_;
  TaggedMesh out_;
  std::map<std::pair<int, std::string>, int> group_numbers_;  // by dimension and name
  std::vector<ElementPlace> places_;
  std::int64_t last_id_ = 0;
};

int MeshGroups::group(int dimension, const std::string& text) {
  const auto [known, is_new] = group_numbers_.try_emplace({dimension, group_name(text)},
                                                          static_cast<int>(out_.groups.size()));
  if (is_new) {
    const auto tag = static_cast<std::int64_t>(out_.groups.size()) + 1;
    out_.groups.push_back({dimension, tag, known->first.second});
  }
  return known->second;
}

void MeshGroups::add_elements() {
  std::vector<std::vector<int>> groups(places_.size());
  const std::vector<std::string> names = property_groups(mesh_);
  std::size_t first = 0;
  for (const fem::ImportedBlock& block : mesh_.blocks) {
    const std::size_t end = first + block.ids.size();
    if (block.property >= 0) {
      const int own =
          group(fem::dimension_of(block.kind), names[static_cast<std::size_t>(block.property)]);
      for (std::size_t e = first; e < end; ++e) groups[e].push_back(own);
    }
    first = end;
  }
  for (const fem::ImportedElementSet& set : mesh_.element_sets) {
    std::array<int, 4> own = {-1, -1, -1, -1};  // by dimension
    for (const int element : set.elements) {
      const auto e = static_cast<std::size_t>(element);
      const int dimension = fem::dimension_of(places_[e].block->kind);
      int& number = own[static_cast<std::size_t>(dimension)];
      if (number < 0) number = group(dimension, set.name);
      groups[e].push_back(number);
    }
  }
  std::unordered_set<std::int64_t> ids;
  int renumbered = 0;
  for (std::size_t e = 0; e < places_.size(); ++e) {
    const ElementPlace& place = places_[e];
    const CellKind kind = place.block->kind;
    std::int64_t id = place.block->ids[static_cast<std::size_t>(place.element)];
    if (!ids.insert(id).second) {
      id = ++last_id_;
      ++renumbered;
    }
    TaggedCells& cells = out_.cells_of(kind, gmsh_element(kind).name, groups[e]);
    cells.ids.push_back(id);
    cells.nodes.insert(cells.nodes.end(), place.nodes(), place.nodes() + fem::num_nodes(kind));
  }
  if (renumbered > 0) {
    out_.notes.push_back(
        {"elements whose number is already taken, such as the second half of a quadratic beam, are "
         "renumbered",
         0, renumbered});
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

/// Whether the faces are the sides towards the normals of the shells in the element set of the same
/// name. Its group then says all.
bool MeshGroups::is_group_of_shells(const fem::ImportedFaceSet& set) const {
  for (const fem::ImportedFace& face : set.faces) {
    const ElementPlace& place = places_[static_cast<std::size_t>(face.element)];
    const CellKind kind = place.block->kind;
    if (fem::dimension_of(kind) != 2) return false;
    const int* first = place.nodes();
    const int corners = fem::num_corners(kind);
    const auto at = std::find(first, first + corners, face.corners.at(0)) - first;
    if (at == corners || first[(at + 1) % corners] != face.corners.at(1)) return false;
  }
  const auto* known = base::find_named(mesh_.element_sets, set.name);
  std::set<int> elements, members;
  for (const fem::ImportedFace& face : set.faces) elements.insert(face.element);
  if (known != nullptr) members.insert(known->elements.begin(), known->elements.end());
  return elements == members;
}

void MeshGroups::add_faces() {
  struct Surface {
    std::vector<int> nodes, groups;
  };
  std::map<std::vector<int>, std::size_t> known;  // by sorted nodes
  std::vector<Surface> surfaces;
  int of_shells = 0;
  for (const fem::ImportedFaceSet& set : mesh_.face_sets) {
    if (is_group_of_shells(set)) continue;
    int own = -1;
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
      if (own < 0) own = group(2, set.name);
      surfaces[found->second].groups.push_back(own);
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
        {"faces of shells cannot be written to a Gmsh mesh, except as an element set seen from the "
         "side of its normals, and are left out",
         0, of_shells});
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

TaggedMesh MeshGroups::made() && {
  out_.file = mesh_.file;
  out_.format = mesh_.format;
  out_.node_ids = mesh_.node_ids;
  out_.positions = mesh_.positions;
  const std::vector<std::string> names = property_groups(mesh_);
  std::vector<std::set<int>> dimensions(names.size());
  for (const fem::ImportedBlock& block : mesh_.blocks) {
    if (block.property < 0) continue;
    dimensions[static_cast<std::size_t>(block.property)].insert(fem::dimension_of(block.kind));
  }
  for (std::size_t p = 0; p < names.size(); ++p) {
    for (const int dimension : dimensions[p]) group(dimension, names[p]);
  }
  add_elements();
  add_faces();
  add_node_sets();
  return std::move(out_);
}

}  // namespace

std::string group_name(const std::string& name) {
  std::string out = name;
  for (char& c : out) {
    if (c == '"') c = '\'';
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
  return out;
}

std::vector<std::string> property_groups(const ImportedMesh& mesh) {
  std::vector<std::vector<int>> members(mesh.properties.size());  // ascending, like those of sets
  int element = 0;
  for (const fem::ImportedBlock& block : mesh.blocks) {
    for (int e = 0; e < block.num_elements(); ++e, ++element) {
      if (block.property >= 0) {
        members[static_cast<std::size_t>(block.property)].push_back(element);
      }
    }
  }
  std::multimap<std::string, const fem::ImportedElementSet*> sets;
  for (const fem::ImportedElementSet& set : mesh.element_sets) {
    sets.emplace(group_name(set.name), &set);
  }
  std::set<std::string> taken;
  std::map<std::string, int> last_number;  // behind names that several properties want
  std::vector<std::string> out;
  for (std::size_t p = 0; p < mesh.properties.size(); ++p) {
    const std::string wanted = group_name(mesh.properties[p].name);
    const auto is_free = [&](const std::string& name) {
      const auto [first, last] = sets.equal_range(name);
      return !taken.contains(name) && std::all_of(first, last, [&](const auto& entry) {
        return entry.second->elements == members[p];
      });
    };
    std::string name = wanted.empty() ? "property" : wanted;
    int& k = last_number.try_emplace(wanted, 1).first->second;
    while (!is_free(name)) name = fmt::format("{} ({})", wanted, ++k);
    taken.insert(name);
    out.push_back(name);
  }
  return out;
}

TaggedMesh groups_of_mesh(const ImportedMesh& mesh) { return MeshGroups(mesh).made(); }

}  // namespace buckens::mesh_io
