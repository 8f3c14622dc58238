// SPDX-License-Identifier: Apache-2.0
#include <array>

#include <fmt/format.h>

#include "buckens/mesh_io/gmsh/reader.h"

namespace buckens::mesh_io {

namespace {

constexpr std::int64_t kAny = std::numeric_limits<std::int32_t>::min();
// Numbers of groups that no physical group has.
constexpr std::int64_t kSurfaces = std::int64_t{1} << 33;

}  // namespace

bool GmshSections4::read(const std::string& section) {
  if (section == "$Entities") {
    read_entities();
  } else if (section == "$Nodes") {
    read_nodes();
  } else if (section == "$Elements") {
    read_elements();
  } else if (section == "$PartitionedEntities") {
    read_partitioned_entities();
  } else {
    return false;
  }
  return true;
}

/// A point, or the corners of a box. Gmsh writes infinite boxes of empty entities, so that nothing
/// is asked of these numbers.
void GmshSections4::skip_box(int dimension) {
  const int count = dimension == 0 && !is_4_0_ ? 3 : 6;
  for (int k = 0; k < count; ++k) {
    if (reader_.is_binary()) {
      reader_.text().binary<double>("a corner of an entity");
    } else {
      reader_.text().word("a corner of an entity");
    }
  }
}

void GmshSections4::read_groups(int dimension, std::vector<int>& groups) {
  const std::size_t physical = reader_.count64("the number of physical groups", 2, 4);
  for (std::size_t k = 0; k < physical; ++k) {
    const std::int64_t group = reader_.int32("the number of a physical group", kAny + 1);
    if (group != 0) groups.push_back(reader_.mesh().group(dimension, std::abs(group)));
  }
  if (dimension == 0) return;
  const std::size_t boundary = reader_.count64("the number of bounding entities", 2, 4);
  for (std::size_t k = 0; k < boundary; ++k) reader_.int32("a bounding entity", kAny);
}

void GmshSections4::read_entities() {
  std::array<std::size_t, 4> counts;
  for (std::size_t& count : counts) count = reader_.count64("a number of entities", 8, 36);
  for (int dimension = 0; dimension < 4; ++dimension) {
    for (std::size_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i) {
      const std::int64_t tag = reader_.int32("the number of an entity", kAny);
      skip_box(dimension);
      std::vector<int>& groups = groups_[{dimension, tag}];
      read_groups(dimension, groups);
      if (dimension == 2 && !surface_.empty()) groups = {group_of_surface(tag)};
    }
  }
}

int GmshSections4::group_of_surface(std::int64_t tag) {
  const int out = reader_.mesh().group(2, kSurfaces + tag);
  reader_.mesh().groups[static_cast<std::size_t>(out)].name = fmt::format("{}{}", surface_, tag);
  return out;
}

/// Parts of a divided mesh: entities with groups of their own, beside those that they come from.
void GmshSections4::read_partitioned_entities() {
  if (is_4_0_) {
    reader_.text().fail(
        "the mesh is divided into partitions; save it in one piece (in Gmsh: Mesh > Unpartition)");
  }
  reader_.count64("the number of partitions", 1, 1);
  const std::size_t ghosts = reader_.count64("the number of ghost entities", 4, 8);
  for (std::size_t i = 0; i < 2 * ghosts; ++i) reader_.int32("a ghost entity", kAny);
  std::array<std::size_t, 4> counts;
  for (std::size_t& count : counts) count = reader_.count64("a number of entities", 8, 36);
  for (int dimension = 0; dimension < 4; ++dimension) {
    for (std::size_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i) {
      const std::int64_t tag = reader_.int32("the number of an entity", kAny);
      for (int k = 0; k < 2; ++k) reader_.int32("the entity that was divided", kAny);
      const std::size_t parts = reader_.count64("the number of partitions", 2, 4);
      for (std::size_t k = 0; k < parts; ++k) reader_.int32("a partition", kAny);
      skip_box(dimension);
      std::vector<int>& groups = groups_[{dimension, tag}];
      groups.clear();
      read_groups(dimension, groups);
    }
  }
}

/// Dimension and number of the entity that a block of nodes or elements lies on.
std::pair<int, std::int64_t> GmshSections4::read_entity() {
  if (!is_4_0_) {
    const auto dimension = static_cast<int>(reader_.int32("the dimension of an entity", 0));
    return {dimension, reader_.int32("the number of an entity", kAny)};
  }
  const std::int64_t tag = reader_.int32("the number of an entity", kAny);
  return {static_cast<int>(reader_.int32("the dimension of an entity", 0)), tag};
}

void GmshSections4::add_node(std::int64_t id, bool is_parametric, int dimension) {
  Eigen::Vector3d position;
  for (double& x : position) x = reader_.real("a coordinate of a node");
  for (int k = 0; is_parametric && k < std::min(dimension, 3); ++k) {
    reader_.real("a parameter of a node");
  }
  reader_.add_node(id, position);
}

void GmshSections4::read_nodes() {
  const std::size_t blocks = reader_.count64("the number of blocks of nodes", 8, 20);
  const std::size_t total = reader_.count64("the number of nodes", 8, 28);
  for (int k = 0; !is_4_0_ && k < 2; ++k) {
    reader_.int64("the least or largest number of a node", 0);
  }
  const std::size_t before = reader_.mesh().positions.size();
  for (std::size_t block = 0; block < blocks; ++block) {
    const int dimension = read_entity().first;
    const bool is_parametric = reader_.int32("\"parametric\", 0 or 1,", 0) != 0;
    const std::size_t count = reader_.count64("the number of nodes of an entity", 8, 28);
    if (is_4_0_) {
      for (std::size_t i = 0; i < count; ++i) {
        add_node(reader_.int32("the number of a node", 0), is_parametric, dimension);
      }
      continue;
    }
    std::vector<std::int64_t> ids(count);
    for (std::int64_t& id : ids) id = reader_.int64("the number of a node", 0);
    for (const std::int64_t id : ids) add_node(id, is_parametric, dimension);
  }
  const std::size_t read = reader_.mesh().positions.size() - before;
  if (read == total) return;
  reader_.text().fail(
      fmt::format("the section $Nodes has {} nodes but says {} at its head", read, total));
}

void GmshSections4::read_elements() {
  const std::size_t blocks = reader_.count64("the number of blocks of elements", 8, 20);
  const std::size_t total = reader_.count64("the number of elements", 4, 16);
  for (int k = 0; !is_4_0_ && k < 2; ++k) {
    reader_.int64("the least or largest number of an element", 0);
  }
  const auto number = [this](std::string_view what) {
    return is_4_0_ ? reader_.int32(what, 0) : reader_.int64(what, 0);
  };
  std::size_t read = 0;
  for (std::size_t block = 0; block < blocks; ++block) {
    const auto [dimension, entity] = read_entity();
    const GmshElement& element = reader_.element_of(reader_.int32("the type of elements", 1));
    const std::size_t count = reader_.count64("the number of elements of an entity", 4, 16);
    if (dimension != fem::dimension_of(element.kind)) {
      reader_.text().fail(
          fmt::format("elements of type \"{}\" cannot lie on an entity of "
                      "dimension {}",
                      element.name, dimension));
    }
    const auto groups = groups_.find({dimension, entity});
    std::vector<std::int64_t> nodes(static_cast<std::size_t>(element.num_nodes));
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t id = number("the number of an element");
      for (std::int64_t& node : nodes) node = number("a node of an element");
      reader_.add_element(element, id,
                          groups == groups_.end() ? std::vector<int>() : groups->second, nodes);
    }
    read += count;
  }
  if (read == total) return;
  reader_.text().fail(
      fmt::format("the section $Elements has {} elements but says {} at its head", read, total));
}

}  // namespace buckens::mesh_io
