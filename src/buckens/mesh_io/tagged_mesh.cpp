// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/tagged_mesh.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <tuple>
#include <unordered_map>
#include <unordered_set>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/fem/mesh/cell_faces.h"

namespace buckens::mesh_io {

using fem::CellKind;
using fem::ImportedMesh;

namespace {

constexpr std::array<const char*, 4> kEntity = {"point", "curve", "surface", "volume"};

/// Corners of a face, an edge or an element, sorted; −1 fills up.
using CornerKey = std::array<int, 8>;

struct CornerHash {
  std::size_t operator()(const CornerKey& key) const {
    std::uint64_t out = 1469598103934665603U;
    for (const int corner : key) {
      out = (out ^ static_cast<std::uint32_t>(corner)) * 1099511628211U;
      out ^= out >> 29;
    }
    return out;
  }
};

template <class Corners>
CornerKey corner_key(const Corners& corners) {
  CornerKey out;
  out.fill(-1);
  std::copy(corners.begin(), corners.end(), out.begin());
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<int> nodes_of(const TaggedCells& cells, std::size_t element, int count) {
  const auto first =
      cells.nodes.begin() + static_cast<std::ptrdiff_t>(element) * fem::num_nodes(cells.kind);
  return {first, first + count};
}

CornerKey corner_key(const TaggedCells& cells, std::size_t element) {
  return corner_key(nodes_of(cells, element, fem::num_corners(cells.kind)));
}

/// Builds the mesh of elements and sets out of a tagged mesh.
class GroupMesh {
 public:
  GroupMesh(TaggedMesh tagged, const std::vector<std::string>& members)
      : tagged_(std::move(tagged)), members_(members.begin(), members.end()) {}

  ImportedMesh made() &&;

 private:
  /// Where a surface lies on a volume.
  struct Side {
    int element = -1;  // −1: nowhere
    std::array<int, 4> corners = {-1, -1, -1, -1};
  };

  void merge_repeated();
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
  ImportedMesh mesh_;
  std::unordered_map<CornerKey, Side, CornerHash> sides_;  // of all surfaces
  std::unordered_map<CornerKey, bool, CornerHash> edges_;  // all lines: whether they are edges
  std::map<int, int> properties_;                          // by group
  std::map<int, std::vector<int>> element_sets_;           // by group
  std::map<int, std::vector<fem::ImportedFace>> faces_;    // by group
};

/// Version 2.2 writes an element once for each group that it belongs to. The lowest number stays.
void GroupMesh::merge_repeated() {
  struct Place {
    std::size_t cells, element;
  };
  std::unordered_map<CornerKey, Place, CornerHash> first;
  struct Merged {
    std::set<int> groups;
    std::int64_t id;
  };
  std::map<std::pair<std::size_t, std::size_t>, Merged> merged;
  std::vector<std::vector<bool>> repeated(tagged_.cells.size());
  for (std::size_t c = 0; c < tagged_.cells.size(); ++c) {
    const TaggedCells& cells = tagged_.cells[c];
    repeated[c].resize(cells.ids.size());
    for (std::size_t e = 0; e < cells.ids.size(); ++e) {
      const auto [found, is_new] = first.emplace(corner_key(cells, e), Place{c, e});
      const Place& place = found->second;
      const TaggedCells& other = tagged_.cells[place.cells];
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
  if (merged.empty()) return;
  TaggedMesh out;
  for (std::size_t c = 0; c < tagged_.cells.size(); ++c) {
    const TaggedCells& cells = tagged_.cells[c];
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
  tagged_.cells = std::move(out.cells);
}

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
                       fmt::format("two elements have the number {}; in Gmsh, Mesh.Renumber or "
                                   "saving anew numbers them",
                                   id));
    }
  }
}

ImportedMesh GroupMesh::made() && {
  mesh_.file = tagged_.file;
  mesh_.format = tagged_.format;
  mesh_.notes = tagged_.notes;
  if (tagged_.repeats_elements) merge_repeated();
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

}  // namespace

TaggedCells& TaggedMesh::cells_of(CellKind kind, const std::string& source,
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
