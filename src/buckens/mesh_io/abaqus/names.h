// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "buckens/mesh_io/abaqus/lines.h"
#include "buckens/mesh_io/abaqus/scope.h"
#include "buckens/mesh_io/label_index.h"

namespace buckens::mesh_io {

/// A scope placed in the assembly, with its nodes and elements numbered.
struct AbaqusPlaced {
  const AbaqusScope* scope = nullptr;
  std::string instance;  ///< empty: the assembly or a deck without parts
  /// p → rotation p + origin maps the part to the assembly.
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  int first_node = 0;   ///< in the whole mesh
  int num_nodes = 0;    ///< identical duplicates count once
  LabelIndex nodes;     ///< to the whole mesh
  LabelIndex elements;  ///< to indices through the blocks of the scope
  std::vector<int> first_of_block;
  int num_elements = 0;

  /// A block of the scope and an index in it.
  std::pair<const AbaqusElements*, std::size_t> at(int element) const;
};

/// A face of an element of a surface.
struct AbaqusFace {
  int scope = 0;  ///< index of the placed scope
  int element = 0;
  std::vector<int> corners;  ///< nodes of the whole mesh
  std::vector<int> nodes;    ///< with those at mid-sides
  bool is_edge = false;      ///< of a shell: provides nodes but no face
};

/// Elements of one placed scope each.
struct AbaqusElementAt {
  int scope = 0;
  int element = 0;

  auto operator<=>(const AbaqusElementAt&) const = default;  // NOLINT(modernize-use-nullptr)
};

/// Looks up the meaning of names and numbers of a deck in the scope in which they occur.
class AbaqusNames {
 public:
  /// Numbers nodes and elements.
  /// @throws InputError if a number is given twice or an element refers to a missing node
  AbaqusNames(const AbaqusDeck& deck, const AbaqusLines& lines);

  const std::vector<AbaqusPlaced>& scopes() const { return scopes_; }
  const std::vector<Eigen::Vector3d>& positions() const { return positions_; }
  /// Numbers of the nodes in the deck, instance by instance.
  const std::vector<std::int64_t>& labels() const { return labels_; }

  /// Nodes of a reference on a data line, ascending: a number is that of a node, as in CalculiX,
  /// even if a set has this number as its name.
  /// @throws InputError if it does not exist
  std::vector<int> nodes(int scope, const std::string& reference, DeckPlace place);
  /// Nodes of a set by the name given by a parameter (NSET=2): a set of this name takes precedence
  /// over a node of this number.
  std::vector<int> nodes_of_set(int scope, const std::string& name, DeckPlace place);
  /// Nodes of a reference in the order in which two sets are paired: by number, or as written for
  /// sets with UNSORTED.
  std::vector<int> nodes_in_order(int scope, const std::string& reference, DeckPlace place);
  /// The one node of a reference. @throws InputError also if there are several
  int node(int scope, const std::string& reference, DeckPlace place);
  /// Elements of a reference, as nodes() and nodes_of_set().
  std::vector<AbaqusElementAt> elements(int scope, const std::string& reference, DeckPlace place);
  std::vector<AbaqusElementAt> elements_of_set(int scope, const std::string& name, DeckPlace place);
  std::vector<AbaqusFace> faces(int scope, const AbaqusSurface& surface);
  /// Nodes and elements of a set of a scope, ascending; its name may look like a number.
  std::vector<int> nodes(int scope, const AbaqusSet& set) {
    return members(scope, set, known_nodes_);
  }
  std::vector<AbaqusElementAt> elements(int scope, const AbaqusSet& set) {
    return members(scope, set, known_elements_);
  }
  /// Nodes of a surface, each with its share of the faces (an area), of the edges of shells (a
  /// length) or, for a surface of nodes, the value in the deck (1 by default).
  std::map<int, double> surface_nodes(int scope, const AbaqusSurface& surface);
  /// The same by the name of the surface.
  std::map<int, double> surface_nodes(int scope, const std::string& name, DeckPlace place);
  /// Faces of the surface of elements with this name; none if it is one of nodes.
  std::vector<AbaqusFace> faces(int scope, const std::string& name, DeckPlace place);
  /// Per node whether a shell or beam gives it rotations.
  std::vector<bool> turning_nodes() const;
  /// Nodes of an element, including those at mid-sides.
  std::vector<int> element_nodes(const AbaqusElementAt& at) const;

 private:
  /// A name of the assembly may begin with an instance.
  struct Scoped {
    int scope;
    std::string name;
  };

  void place_scope(const AbaqusScope& scope, const AbaqusInstance* instance);
  void number_elements(AbaqusPlaced& placed);
  Scoped in_instance(int scope, const std::string& reference, const std::string& instance,
                     DeckPlace place) const;
  int find_instance(const std::string& name) const;
  std::string described(int scope) const;
  /// Marks a set as being looked up. @throws InputError if it already is, or sets are nested too
  /// deeply
  void open(const AbaqusSet& set);
  template <class Entry>
  using KnownSets = std::map<std::pair<int, const AbaqusSet*>, std::vector<Entry>>;
  /// The nodes (int) or elements of a set, looked up once.
  template <class Entry>
  const std::vector<Entry>& members(int scope, const AbaqusSet& set, KnownSets<Entry>& known);
  template <class Entry>
  void add_part(int scope, const AbaqusSet& set, const AbaqusSetPart& part,
                std::vector<Entry>& out);
  /// Adds the existing numbers of a range. @return how many these are
  template <class Entry>
  std::size_t add_range(int scope, const AbaqusSetPart::Range& range,
                        std::vector<Entry>& out) const;
  template <class Entry>
  bool add_entry(int scope, std::int64_t label, std::vector<Entry>& out) const;
  void add_faces(const AbaqusElementAt& at, const AbaqusSurface::Item& item,
                 std::vector<AbaqusFace>& out);
  AbaqusFace solid_face(const AbaqusElementAt& at, std::size_t face) const;
  AbaqusFace shell_face(const AbaqusElementAt& at, bool is_positive) const;
  AbaqusFace shell_edge(const AbaqusElementAt& at, std::size_t edge) const;
  bool is_free(const AbaqusElementAt& at, const AbaqusFace& face);

  const AbaqusLines& lines_;
  std::vector<AbaqusPlaced> scopes_;
  std::vector<Eigen::Vector3d> positions_;
  std::vector<std::int64_t> labels_;
  std::vector<const AbaqusSet*> open_sets_;  ///< being looked up, to detect cycles
  /// Sets already looked up: sets of sets would otherwise be traversed again and again.
  KnownSets<int> known_nodes_;
  KnownSets<AbaqusElementAt> known_elements_;
  std::size_t num_entries_ = 0;           ///< of these sets together
  std::map<std::string, int> instances_;  ///< scopes by their names in capitals
  /// Per scope the faces of all its solids by their corners, sorted.
  std::map<int, std::vector<std::array<int, 4>>> faces_;
};

}  // namespace buckens::mesh_io
