// SPDX-License-Identifier: Apache-2.0
#include <array>

#include <fmt/format.h>

#include "buckens/mesh_io/gmsh/reader.h"

namespace buckens::mesh_io {

namespace {

constexpr std::int64_t kAny = std::numeric_limits<std::int32_t>::min();

}  // namespace

bool GmshSections4::read(const std::string& section) {
  if (section == "$Entities") {
    read_entities();
  } else if (section == "$Nodes") {
    read_nodes();
  } else if (section == "$Elements") {
    read_elements();
  } else if (section == "$PartitionedEntities") {
    reader_.text().fail(
        "the mesh is divided into partitions; save it in one piece (in Gmsh: Mesh > Unpartition)");
  } else {
    return false;
  }
  return true;
}

void GmshSections4::read_entities() {
  std::array<std::size_t, 4> counts;
  for (std::size_t& count : counts) count = reader_.count64("a number of entities", 8, 36);
  for (int dimension = 0; dimension < 4; ++dimension) {
    for (std::size_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i) {
      const std::int64_t tag = reader_.int32("the number of an entity", kAny);
      // A point, or the corners of a box. Gmsh writes infinite boxes of empty entities, so that
      // nothing is asked of these numbers.
      for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) {
        if (reader_.is_binary()) {
          reader_.text().binary<double>("a corner of an entity");
        } else {
          reader_.text().word("a corner of an entity");
        }
      }
      std::vector<int>& groups = groups_[{dimension, tag}];
      const std::size_t physical = reader_.count64("the number of physical groups", 2, 4);
      for (std::size_t k = 0; k < physical; ++k) {
        const std::int64_t group = reader_.int32("the number of a physical group", kAny + 1);
        if (group != 0) groups.push_back(reader_.mesh().group(dimension, std::abs(group)));
      }
      if (dimension == 0) continue;
      const std::size_t boundary = reader_.count64("the number of bounding entities", 2, 4);
      for (std::size_t k = 0; k < boundary; ++k) reader_.int32("a bounding entity", kAny);
    }
  }
}

void GmshSections4::read_nodes() {
  const std::size_t blocks = reader_.count64("the number of blocks of nodes", 8, 20);
  const std::size_t total = reader_.count64("the number of nodes", 8, 32);
  for (int k = 0; k < 2; ++k) reader_.int64("the least or largest number of a node", 0);
  const std::size_t before = reader_.mesh().positions.size();
  for (std::size_t block = 0; block < blocks; ++block) {
    const std::int64_t dimension = reader_.int32("the dimension of an entity", 0);
    reader_.int32("the number of an entity", kAny);
    const bool is_parametric = reader_.int32("\"parametric\", 0 or 1,", 0) != 0;
    const std::size_t count = reader_.count64("the number of nodes of an entity", 8, 32);
    std::vector<std::int64_t> ids(count);
    for (std::int64_t& id : ids) id = reader_.int64("the number of a node", 0);
    for (const std::int64_t id : ids) {
      Eigen::Vector3d position;
      for (double& x : position) x = reader_.real("a coordinate of a node");
      for (int k = 0; is_parametric && k < std::min<std::int64_t>(dimension, 3); ++k) {
        reader_.real("a parameter of a node");
      }
      reader_.add_node(id, position);
    }
  }
  const std::size_t read = reader_.mesh().positions.size() - before;
  if (read == total) return;
  reader_.text().fail(
      fmt::format("the section $Nodes has {} nodes but says {} at its head", read, total));
}

void GmshSections4::read_elements() {
  const std::size_t blocks = reader_.count64("the number of blocks of elements", 8, 20);
  const std::size_t total = reader_.count64("the number of elements", 4, 16);
  for (int k = 0; k < 2; ++k) reader_.int64("the least or largest number of an element", 0);
  std::size_t read = 0;
  for (std::size_t block = 0; block < blocks; ++block) {
    const auto dimension = static_cast<int>(reader_.int32("the dimension of an entity", 0));
    const std::int64_t entity = reader_.int32("the number of an entity", kAny);
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
      const std::int64_t id = reader_.int64("the number of an element", 0);
      for (std::int64_t& node : nodes) node = reader_.int64("a node of an element", 0);
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
