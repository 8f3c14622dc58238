// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "buckens/mesh_io/gmsh/reader.h"

namespace buckens::mesh_io {

namespace {

constexpr std::int64_t kLowestTag = std::numeric_limits<std::int32_t>::min();

void read_nodes(GmshReader& reader) {
  // The count is text in binary files, too.
  const std::size_t count = reader.text().count("the number of nodes", reader.is_binary() ? 28 : 8);
  if (reader.is_binary()) reader.text().next_line("the first node");
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t id = reader.int32("the number of a node", 0);
    Eigen::Vector3d position;
    for (double& x : position) x = reader.real("a coordinate of a node");
    reader.add_node(id, position);
  }
}

/// Elements of one kind with the same number of tags; text has one element in each.
struct Header {
  const GmshElement* element;
  std::size_t count, tags;
};

void read_tags_and_nodes(GmshReader& reader, const Header& header, std::int64_t id) {
  std::vector<int> groups;
  for (std::size_t i = 0; i < header.tags; ++i) {
    const std::int64_t tag = reader.int32("a tag of an element", kLowestTag + 1);
    // The first is the physical group, negative where it looks the other way.
    if (i > 0 || tag == 0) continue;
    groups.push_back(reader.mesh().group(fem::dimension_of(header.element->kind), std::abs(tag)));
  }
  std::vector<std::int64_t> nodes(static_cast<std::size_t>(header.element->num_nodes));
  for (std::int64_t& node : nodes) node = reader.int32("a node of an element", 0);
  reader.add_element(*header.element, id, groups, nodes);
}

void read_elements(GmshReader& reader) {
  const std::size_t count =
      reader.text().count("the number of elements", reader.is_binary() ? 8 : 6);
  if (!reader.is_binary()) {
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t id = reader.int32("the number of an element", 0);
      const GmshElement& element = reader.element_of(reader.int32("the type of an element", 1));
      const std::size_t tags = reader.text().count("the number of tags", 2);
      read_tags_and_nodes(reader, {&element, 1, tags}, id);
    }
    return;
  }
  reader.text().next_line("the first element");
  for (std::size_t done = 0; done < count;) {
    const GmshElement& element = reader.element_of(reader.int32("the type of elements", 1));
    const auto in_block = static_cast<std::size_t>(reader.int32("a number of elements", 1));
    const auto tags = static_cast<std::size_t>(reader.int32("the number of tags", 0));
    if (in_block > count - done) {
      reader.text().fail(fmt::format("{} elements follow, but only {} of {} are still expected",
                                     in_block, count - done, count));
    }
    for (std::size_t i = 0; i < in_block; ++i) {
      read_tags_and_nodes(reader, {&element, in_block, tags},
                          reader.int32("the number of an element", 0));
    }
    done += in_block;
  }
}

/// Version 1: number, type, physical group, entity, number of nodes, nodes.
void read_old_elements(GmshReader& reader) {
  const std::size_t count = reader.text().count("the number of elements", 6);
  for (std::size_t i = 0; i < count; ++i) {
    const std::int64_t id = reader.int32("the number of an element", 0);
    const GmshElement& element = reader.element_of(reader.int32("the type of an element", 1));
    const std::int64_t tag = reader.int32("the physical group of an element", kLowestTag + 1);
    reader.int32("the entity of an element", kLowestTag + 1);
    if (reader.int32("the number of nodes", 1) != element.num_nodes) {
      reader.text().fail(fmt::format("a {} must have {} nodes", element.name, element.num_nodes));
    }
    std::vector<int> groups;
    if (tag != 0) {
      groups.push_back(reader.mesh().group(fem::dimension_of(element.kind), std::abs(tag)));
    }
    std::vector<std::int64_t> nodes(static_cast<std::size_t>(element.num_nodes));
    for (std::int64_t& node : nodes) node = reader.int32("a node of an element", 0);
    reader.add_element(element, id, groups, nodes);
  }
}

}  // namespace

bool read_section_1(GmshReader& reader, const std::string& section) {
  if (section == "$NOD") {
    read_nodes(reader);
  } else if (section == "$ELM") {
    read_old_elements(reader);
  } else {
    return false;
  }
  return true;
}

bool read_section_2(GmshReader& reader, const std::string& section) {
  if (section == "$Nodes") {
    read_nodes(reader);
  } else if (section == "$Elements") {
    read_elements(reader);
  } else {
    return false;
  }
  return true;
}

}  // namespace buckens::mesh_io
