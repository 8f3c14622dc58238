// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/universal/file.h"

#include <algorithm>
#include <map>
#include <unordered_map>

#include <fmt/format.h>

#include "buckens/files/text_lines.h"

namespace buckens::mesh_io {

using fem::CellKind;

namespace {

/// How a universal file writes one shape: along its edges, corners and mid-side nodes in turn.
struct UniversalElement {
  std::vector<int> descriptors;
  const char* name;
  CellKind kind;
  std::vector<int> places;  ///< in the file, of each of our nodes; empty: the same order
};

const std::vector<UniversalElement>& universal_elements() {
  static const std::vector<UniversalElement> all = {
      {{11, 21, 22, 23}, "linear beam", CellKind::line2, {}},
      // Salome writes edges with a node in their middle as tapered beams.
      {{22, 23, 24, 25}, "parabolic beam", CellKind::line3, {0, 2, 1}},
      {{41, 51, 61, 74, 81, 91}, "linear triangle", CellKind::tri3, {}},
      {{42, 52, 62, 72, 82, 92}, "parabolic triangle", CellKind::tri6, {0, 2, 4, 1, 3, 5}},
      {{44, 54, 64, 71, 84, 94}, "linear quadrilateral", CellKind::quad4, {}},
      {{45, 55, 65, 75, 85, 95},
       "parabolic quadrilateral",
       CellKind::quad8,
       {0, 2, 4, 6, 1, 3, 5, 7}},
      {{111}, "linear tetrahedron", CellKind::tet4, {}},
      {{112}, "linear wedge", CellKind::wedge6, {}},
      {{113},
       "parabolic wedge",
       CellKind::wedge15,
       {0, 2, 4, 9, 11, 13, 1, 3, 5, 10, 12, 14, 6, 7, 8}},
      {{115}, "linear brick", CellKind::hex8, {}},
      {{116}, "parabolic brick", CellKind::hex20, {0, 2, 4,  6,  12, 14, 16, 18, 1,  3,
                                                   5, 7, 13, 15, 17, 19, 8,  9,  10, 11}},
      {{118}, "parabolic tetrahedron", CellKind::tet10, {0, 2, 4, 9, 1, 3, 5, 6, 7, 8}},
  };
  return all;
}

/// The shape with a descriptor, of several the one with so many nodes; null if there is none.
const UniversalElement* element_of(std::int64_t descriptor, std::size_t nodes) {
  const UniversalElement* out = nullptr;
  for (const UniversalElement& element : universal_elements()) {
    const auto& own = element.descriptors;
    if (std::find(own.begin(), own.end(), descriptor) == own.end()) continue;
    if (static_cast<std::size_t>(fem::num_nodes(element.kind)) == nodes) return &element;
    if (out == nullptr) out = &element;
  }
  return out;
}

constexpr std::int64_t kRod = 11;
// Data set of nodes in files of vibration tests, on one line each.
constexpr std::int64_t kNodesOfTests = 15;

/// What a mesh cannot hold and the file describes but half: without the tables of properties there
/// is neither a mass nor a stiffness. Null for elements that have a shape.
const char* bodiless_element(std::int64_t descriptor) {
  switch (descriptor) {
    case 121:
    case 122:
      return "rigid elements";
    case 136:
    case 137:
    case 138:
    case 139:
      return "springs";
    case 141:
    case 142:
      return "dampers";
    case 151:
    case 152:
      return "gaps";
    case 161:
      return "lumped masses";
    default:
      return nullptr;
  }
}

std::size_t num_words(std::string_view line) {
  std::vector<std::string_view> words;
  files::split_words(line, words);
  return words.size();
}

class UniversalReader {
 public:
  UniversalReader(MeshText& text, TaggedMesh& mesh) : text_(text), mesh_(mesh) {}

  void read();

 private:
  struct Element {
    const UniversalElement* shape;
    std::int64_t id;
    std::vector<int> nodes, groups;
  };

  bool at_mark() const { return trimmed(text_.peek_line()) == "-1"; }
  static std::string_view trimmed(std::string_view line) {
    while (!line.empty() && line.front() == ' ') line.remove_prefix(1);
    return line;
  }
  void read_nodes();
  void read_elements();
  void read_groups();
  void read_group_members(std::int64_t number, const std::string& name, std::size_t count);
  void read_units();
  bool skip_binary();
  int named_group(int dimension, std::int64_t number, const std::string& name);

  MeshText& text_;
  TaggedMesh& mesh_;
  std::unordered_map<std::int64_t, int> nodes_, element_numbers_;
  std::vector<Element> elements_;
  int unknown_members_ = 0;
  std::map<std::string, int> left_out_;
};

void UniversalReader::read_nodes() {
  while (!at_mark()) {
    const std::int64_t id = text_.integer("the number of a node", 0);
    for (int i = 0; i < 3; ++i) text_.integer("a coordinate system or colour");
    Eigen::Vector3d position;
    for (double& x : position) x = text_.number("a coordinate of a node");
    text_.next_line("the next node");
    if (!nodes_.emplace(id, static_cast<int>(mesh_.positions.size())).second) {
      text_.fail(fmt::format("node {} appears twice", id));
    }
    mesh_.node_ids.push_back(id);
    mesh_.positions.push_back(position);
  }
}

void UniversalReader::read_elements() {
  while (!at_mark()) {
    const std::int64_t id = text_.integer("the number of an element", 0);
    const std::int64_t descriptor = text_.integer("the descriptor of an element", 0);
    for (int i = 0; i < 3; ++i) text_.integer("a property, material or colour");
    const std::size_t count = text_.count("the number of nodes of an element", 2);
    text_.next_line("the nodes of an element");
    // Beams have a line more, with their orientation node and sections; rods have it in files of
    // some programs, Salome among them.
    const bool is_beam = (descriptor >= 21 && descriptor <= 25) ||
                         (descriptor == kRod && count == 2 && num_words(text_.peek_line()) == 3);
    for (int i = 0; is_beam && i < 3; ++i) text_.integer("an orientation or section of a beam");
    const UniversalElement* shape = element_of(descriptor, count);
    std::vector<std::int64_t> ids(count);
    for (std::int64_t& node : ids) node = text_.integer("a node of an element", 0);
    if (const char* what = bodiless_element(descriptor)) {
      ++left_out_[what];
      text_.next_line("the next element");
      continue;
    }
    if (shape == nullptr) {
      text_.fail(
          fmt::format("element {} has the descriptor {}, which cannot be used; beams, "
                      "triangles, quadrilaterals, tetrahedra, wedges and bricks can",
                      id, descriptor));
    }
    if (static_cast<int>(count) != fem::num_nodes(shape->kind)) {
      text_.fail(fmt::format("element {}, a {}, has {} nodes; expected {}", id, shape->name, count,
                             fem::num_nodes(shape->kind)));
    }
    Element element{shape, id, {}, {}};
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t node =
          ids[shape->places.empty() ? i : static_cast<std::size_t>(shape->places[i])];
      const auto found = nodes_.find(node);
      if (found == nodes_.end()) {
        text_.fail(
            fmt::format("element {} refers to node {}, which is not defined before it", id, node));
      }
      element.nodes.push_back(found->second);
    }
    text_.next_line("the next element");
    if (!element_numbers_.emplace(id, static_cast<int>(elements_.size())).second) {
      text_.fail(fmt::format("element {} appears twice", id));
    }
    elements_.push_back(std::move(element));
  }
}

int UniversalReader::named_group(int dimension, std::int64_t number, const std::string& name) {
  const int group = mesh_.group(dimension, number);
  if (!name.empty()) mesh_.groups[static_cast<std::size_t>(group)].name = name;
  return group;
}

void UniversalReader::read_group_members(std::int64_t number, const std::string& name,
                                         std::size_t count) {
  std::vector<int> nodes;
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t type = text_.integer("the type of a member of a group", 0);
    const std::int64_t id = text_.integer("the number of a member of a group", 0);
    for (int k = 0; k < 2; ++k) text_.integer("a leaf or component");
    const auto& known = type == 7 ? nodes_ : element_numbers_;
    if (type != 7 && type != 8) continue;
    const auto found = known.find(id);
    if (found == known.end()) {
      ++unknown_members_;  // Gmsh counts points among the members but writes them nowhere
      continue;
    }
    if (type == 7) {
      nodes.push_back(found->second);
      continue;
    }
    Element& element = elements_[static_cast<std::size_t>(found->second)];
    element.groups.push_back(named_group(fem::dimension_of(element.shape->kind), number, name));
  }
  if (!nodes.empty()) {
    mesh_.group_nodes.emplace_back(named_group(-1, number, name), std::move(nodes));
  }
}

void UniversalReader::read_groups() {
  while (!at_mark()) {
    const std::int64_t number = text_.integer("the number of a group", 0);
    for (int i = 0; i < 6; ++i) text_.integer("a set of a group");
    const std::size_t count = text_.count("the number of members of a group", 8);
    text_.next_line("the name of a group");
    std::string name(trimmed(text_.next_line("the name of a group")));
    read_group_members(number, name.empty() ? fmt::format("group {}", number) : name, count);
    if (count > 0) text_.next_line("the next group");
    // An empty group may leave an empty line.
    while (!text_.at_end() && trimmed(text_.peek_line()).empty()) text_.next_line("the next group");
  }
}

void UniversalReader::read_units() {
  text_.next_line("the units");
  const double length = text_.number("the unit of length");
  mesh_.notes.push_back(
      {fmt::format(
           "the file states that 1 m is {:g} of its length units; set `length-unit` accordingly",
           length),
       text_.line(), 1});
}

/// Measured functions as bytes: 58b.
bool UniversalReader::skip_binary() {
  const std::string_view head = trimmed(text_.peek_line());
  const std::size_t length = head.find_first_not_of("0123456789");
  if (length == 0 || length == std::string_view::npos || head[length] != 'b') return false;
  const std::string name(head.substr(0, length + 1));
  if (!text_.skip_to("    -1", true)) {
    text_.fail(fmt::format("the data set {} has no end; the file seems to be truncated", name));
  }
  mesh_.notes.push_back({fmt::format("the data set {} is ignored", name), text_.line(), 1});
  return true;
}

void UniversalReader::read() {
  bool found_nodes = false;
  while (!text_.at_end()) {
    const std::string_view line = trimmed(text_.next_line("a data set"));
    if (line.empty()) continue;
    if (line != "-1") {
      text_.fail("expected -1, which begins a data set; is this a universal file?");
    }
    if (text_.at_end()) break;
    if (skip_binary()) continue;
    const std::int64_t set = text_.integer("the number of a data set", 0);
    text_.next_line("a data set");
    if (set == 2411 || set == 781 || set == kNodesOfTests) {
      read_nodes();
      found_nodes = true;
    } else if (set == 2412) {
      read_elements();
    } else if (set == 2435 || set == 2452 || set == 2467 || set == 2477) {
      read_groups();
    } else {
      if (set == 164) read_units();
      while (!at_mark()) text_.next_line("-1, the end of the data set,");
      if (set != 164 && set != 151) {
        mesh_.notes.push_back({fmt::format("the data set {} is ignored", set), text_.line(), 1});
      }
    }
    text_.next_line("-1, the end of the data set,");
  }
  if (!found_nodes) text_.fail("the file has no nodes (data sets 2411, 781, 15)");
  if (unknown_members_ > 0) {
    mesh_.notes.push_back(
        {"members of groups that the file does not have are left out", 0, unknown_members_});
  }
  for (const auto& [what, count] : left_out_) {
    const std::string text = what +
                             " are left out; give what they are in the model file: point "
                             "masses, links, springs";
    mesh_.notes.push_back({text, 0, count, false, true});
  }
  for (Element& element : elements_) {
    std::sort(element.groups.begin(), element.groups.end());
    element.groups.erase(std::unique(element.groups.begin(), element.groups.end()),
                         element.groups.end());
    TaggedCells& cells = mesh_.cells_of(element.shape->kind, element.shape->name, element.groups);
    cells.ids.push_back(element.id);
    cells.nodes.insert(cells.nodes.end(), element.nodes.begin(), element.nodes.end());
  }
}

}  // namespace

TaggedMesh read_universal_file(MeshText& text, const std::string& file) {
  TaggedMesh mesh;
  mesh.file = file;
  mesh.format = "universal file";
  mesh.repeats_elements = false;  // groups name their members
  UniversalReader(text, mesh).read();
  return mesh;
}

}  // namespace buckens::mesh_io
