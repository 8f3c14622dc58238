// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "buckens/fem/mesh/imported_mesh.h"

namespace buckens::mesh_io {

/// Elements of any dimension under a name: a physical group of Gmsh.
struct CellGroup {
  int dimension = 0;  ///< −1: nodes only
  std::int64_t tag = 0;
  std::string name;
};

/// Elements of one shape that belong to the same groups.
struct TaggedCells {
  fem::CellKind kind = fem::CellKind::tet4;
  std::string source;
  std::vector<int> groups;  ///< in TaggedMesh::groups, ascending
  std::vector<std::int64_t> ids;
  std::vector<int> nodes;
};

/// A mesh in which lines, surfaces and volumes are all elements, as in Gmsh.
struct TaggedMesh {
  std::string file;
  std::string format;
  std::vector<std::int64_t> node_ids;
  std::vector<Eigen::Vector3d> positions;
  std::vector<CellGroup> groups;
  std::vector<TaggedCells> cells;
  std::vector<std::pair<int, std::vector<int>>> group_nodes;  ///< further nodes of a group
  /// Nodes that elements in the file have but ours do not: in the middle of faces and volumes. They
  /// are dropped unless something else uses them.
  std::vector<int> dropped_nodes;
  std::vector<fem::ImportNote> notes;
  /// Whether an element is listed once for each group it belongs to. Otherwise elements between the
  /// same nodes, such as two parallel bars, are distinct.
  bool repeats_elements = true;

  /// The elements of this shape and these groups, created if there are none yet.
  TaggedCells& cells_of(fem::CellKind kind, const std::string& source, std::vector<int> groups);
  /// Number of the group, created with a name from dimension and tag if unknown.
  int group(int dimension, std::int64_t tag);

 private:
  std::map<std::pair<fem::CellKind, std::vector<int>>, std::size_t> places_;
  std::map<std::pair<int, std::int64_t>, int> group_numbers_;
};

/// Volumes become elements, their groups properties and element sets. Surfaces become sets of faces
/// of the volumes they are on; groups of surfaces that touch no volume become shells, whose sides
/// towards the normals are sets of faces; and lines become beams if there is nothing else, or if
/// they are not edges of other elements. Every group is also a set of nodes.
/// @param members names of groups whose surfaces and lines always become elements
fem::ImportedMesh mesh_of_groups(TaggedMesh tagged, const std::vector<std::string>& members = {});

/// A valid group name: without quotation marks and line ends.
std::string group_name(const std::string& name);

/// The group for each property. It has the property's name, unless another property or an element
/// set with other members uses it; then a number is appended.
std::vector<std::string> property_groups(const fem::ImportedMesh& mesh);

/// The inverse: what mesh_of_groups() makes into this mesh. Properties come before other groups, so
/// that the first group of an element is its property. Node sets are groups of points unless
/// another group has the same name and nodes. It can only hold nodes, elements and sets; sets that
/// do not fit are listed in `notes`.
TaggedMesh groups_of_mesh(const fem::ImportedMesh& mesh);

}  // namespace buckens::mesh_io
