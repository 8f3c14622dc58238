// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/gmsh/reader.h"

#include <fmt/format.h>

namespace buckens::mesh_io {

namespace {

constexpr std::int64_t kMostTag = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kMostInt = std::numeric_limits<std::int32_t>::max();

/// Gmsh's numbers of lines, triangles, quadrangles, tetrahedra, prisms and hexahedra of order three
/// to ten, complete or without nodes inside; second order ends at 19.
bool is_of_high_order(std::int64_t type) {
  return (type >= 20 && type <= 33) || (type >= 36 && type <= 66) || (type >= 71 && type <= 75) ||
         (type >= 79 && type <= 83) || (type >= 90 && type <= 131);
}

}  // namespace

std::int64_t GmshReader::int32(std::string_view what, std::int64_t least) {
  return is_binary_ ? text_.binary_integer<std::int32_t>(what, least, kMostInt)
                    : text_.integer(what, least, kMostInt);
}

std::int64_t GmshReader::int64(std::string_view what, std::int64_t least) {
  return is_binary_ ? text_.binary_integer<std::uint64_t>(what, least, kMostTag)
                    : text_.integer(what, least, kMostTag);
}

double GmshReader::real(std::string_view what) {
  return is_binary_ ? text_.binary_number(what) : text_.number(what);
}

std::size_t GmshReader::count64(std::string_view what, std::size_t text_bytes,
                                std::size_t binary_bytes) {
  return is_binary_ ? text_.binary_count(what, binary_bytes) : text_.count(what, text_bytes);
}

void GmshReader::expect_end(const std::string& section) {
  const bool is_old = section == "$NOD" || section == "$ELM";
  const std::string mark = (is_old ? "$END" : "$End") + section.substr(1);
  if (text_.word(mark) == mark) return;
  text_.fail(fmt::format(
      "expected {}; a number at the head of the section {} is wrong, or data are missing", mark,
      section));
}

void GmshReader::read_physical_names() {
  const std::size_t count = text_.count("the number of physical names", 5);
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t first = text_.integer("the dimension of a physical group", -1, kMostInt);
    const std::string_view rest = text_.peek_line();
    const std::size_t begin = rest.find_first_not_of(" \t");
    // Gmsh 2.3 did not write dimensions, others write -1 for any.
    const bool is_tag = begin != std::string_view::npos && rest[begin] == '"';
    const std::int64_t tag =
        is_tag ? first : text_.integer("the number of a physical group", -kMostInt, kMostInt);
    const std::string name = text_.quoted("the name of a physical group");
    // Other programs add words of their own.
    if (!text_.at_end()) text_.next_line("the next physical group");
    if (is_tag || first == -1) {
      names_of_any_[std::abs(tag)] = name;
      continue;
    }
    if (first > 3) text_.fail(fmt::format("the dimension of a physical group cannot be {}", first));
    const int group = mesh_.group(static_cast<int>(first), std::abs(tag));
    if (!name.empty()) mesh_.groups[static_cast<std::size_t>(group)].name = name;
  }
}

void GmshReader::name_groups() {
  for (CellGroup& group : mesh_.groups) {
    const auto found = names_of_any_.find(group.tag);
    if (found != names_of_any_.end() && !found->second.empty()) group.name = found->second;
  }
}

void GmshReader::add_node(std::int64_t id, const Eigen::Vector3d& position) {
  if (!numbers_.emplace(id, static_cast<int>(mesh_.positions.size())).second) {
    text_.fail(fmt::format("node {} appears twice", id));
  }
  mesh_.node_ids.push_back(id);
  mesh_.positions.push_back(position);
}

const GmshElement& GmshReader::element_of(std::int64_t type) const {
  const GmshElement* found = gmsh_element(static_cast<int>(type));
  if (found == nullptr && is_of_high_order(type)) {
    text_.fail(
        fmt::format("elements of third or higher order (Gmsh's type {}) cannot be used; "
                    "make the mesh in second order (in Gmsh: `Mesh.ElementOrder = 2` or "
                    "`gmsh -order 2`)",
                    type));
  }
  if (found == nullptr) {
    text_.fail(fmt::format("elements of Gmsh's type {} cannot be used; {} can", type,
                           gmsh_element_names()));
  }
  return *found;
}

void GmshReader::add_element(const GmshElement& element, std::int64_t id,
                             const std::vector<int>& groups,
                             const std::vector<std::int64_t>& nodes) {
  std::vector<int> places;
  for (const std::int64_t node : nodes) {
    const auto found = numbers_.find(node);
    if (found == numbers_.end()) {
      text_.fail(
          fmt::format("element {} refers to node {}, which the file does not have", id, node));
    }
    places.push_back(found->second);
  }
  TaggedCells& cells = mesh_.cells_of(element.kind, element.name, groups);
  cells.ids.push_back(id);
  if (element.places.empty()) {
    cells.nodes.insert(cells.nodes.end(), places.begin(), places.end());
    return;
  }
  for (const int place : element.places) {
    cells.nodes.push_back(places[static_cast<std::size_t>(place)]);
  }
  for (std::size_t i = element.places.size(); i < places.size(); ++i) {
    mesh_.dropped_nodes.push_back(places[i]);
  }
}

}  // namespace buckens::mesh_io
