// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "buckens/mesh_io/gmsh/elements.h"
#include "buckens/mesh_io/mesh_text.h"
#include "buckens/mesh_io/tagged_mesh.h"

namespace buckens::mesh_io {

/// What the readers of all versions of .msh share: groups, nodes by number, elements.
class GmshReader {
 public:
  GmshReader(MeshText& text, TaggedMesh& mesh, bool is_binary)
      : text_(text), mesh_(mesh), is_binary_(is_binary) {}

  /// Names of physical groups; text in binary files, too.
  void read_physical_names();
  void add_node(std::int64_t id, const Eigen::Vector3d& position);
  /// @param nodes their numbers, in Gmsh's order
  void add_element(const GmshElement& element, std::int64_t id, const std::vector<int>& groups,
                   const std::vector<std::int64_t>& nodes);
  /// The element type with a Gmsh number. @throws InputError for unsupported ones
  const GmshElement& element_of(std::int64_t type) const;
  /// Names groups whose dimension was not given. Call it at the end.
  void name_groups();
  /// Checks that the section ends here.
  void expect_end(const std::string& section);

  // One number, from text or binary.
  std::int64_t int32(std::string_view what, std::int64_t least);
  std::int64_t int64(std::string_view what, std::int64_t least);
  double real(std::string_view what);
  std::size_t count64(std::string_view what, std::size_t text_bytes, std::size_t binary_bytes);

  MeshText& text() { return text_; }
  TaggedMesh& mesh() { return mesh_; }
  bool is_binary() const { return is_binary_; }

 private:
  MeshText& text_;
  TaggedMesh& mesh_;
  bool is_binary_;
  std::unordered_map<std::int64_t, int> numbers_;
  std::map<std::int64_t, std::string> names_of_any_;  // of groups without a dimension
};

/// Sections of version 2. @return false for an unknown section
bool read_section_2(GmshReader& reader, const std::string& section);
/// Sections of version 1, which has no header: $NOD and $ELM.
bool read_section_1(GmshReader& reader, const std::string& section);

/// Entities of version 4 carry the physical groups of their elements.
class GmshSections4 {
 public:
  /// @param surface as for read_gmsh_mesh()
  GmshSections4(GmshReader& reader, bool is_4_0, std::string surface)
      : reader_(reader), is_4_0_(is_4_0), surface_(std::move(surface)) {}
  bool read(const std::string& section);

 private:
  void skip_box(int dimension);
  void read_groups(int dimension, std::vector<int>& groups);
  int group_of_surface(std::int64_t tag);
  std::pair<int, std::int64_t> read_entity();
  void add_node(std::int64_t id, bool is_parametric, int dimension);
  void read_entities();
  void read_partitioned_entities();
  void read_nodes();
  void read_elements();

  GmshReader& reader_;
  bool is_4_0_;
  std::string surface_;
  std::map<std::pair<int, std::int64_t>, std::vector<int>> groups_;  // by dimension and tag
};

}  // namespace buckens::mesh_io
