// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>

#include "buckens/mesh_io/abaqus/lines.h"
#include "buckens/mesh_io/abaqus/scope.h"
#include "buckens/mesh_io/label_index.h"
#include "buckens/mesh_io/skip_list.h"

namespace buckens::mesh_io {

/// A deck while it is read.
struct AbaqusReading {
  AbaqusLines lines;
  AbaqusDeck deck;
  AbaqusScope* scope;                     ///< current target of definitions
  fem::MaterialSpec* material = nullptr;  ///< that of the last *MATERIAL
  /// Of *SYSTEM: nodes are at axes × coordinates + origin.
  Eigen::Matrix3d system_axes = Eigen::Matrix3d::Identity();
  Eigen::Vector3d system_origin = Eigen::Vector3d::Zero();
  std::int64_t num_generated = 0;  ///< nodes and elements from *NGEN and the like
  std::string interaction;         ///< of the last *SURFACE INTERACTION, in capitals
  AbaqusLink* coupling = nullptr;  ///< of the last *COUPLING, until its type is known
  std::map<std::string, fem::ImportNote> repeated;  ///< notes that are counted, by their text

  SkipList& skip;  ///< what the model file asks to leave out

  AbaqusReading(const std::filesystem::path& path, SkipList& left_out)
      : lines(path), scope(&deck.root), skip(left_out) {}

  /// Adds a note, or counts it if it is already there.
  /// @param is_expected see fem::ImportNote
  void note(DeckPlace place, const std::string& text, bool is_expected = false);
  /// Value of a parameter.
  /// @throws InputError if it is missing or empty
  const std::string& parameter(const DeckKeyword& keyword, const char* key) const;
  /// Value of a parameter, empty if it is missing.
  std::string optional_parameter(const DeckKeyword& keyword, const char* key) const;
};

/// A card reads a keyword with its data lines.
using AbaqusCard = void (*)(AbaqusReading&, const DeckKeyword&);

// Mesh: nodes, elements, sets, surfaces.
void read_nodes(AbaqusReading& in, const DeckKeyword& keyword);
void read_elements(AbaqusReading& in, const DeckKeyword& keyword);
void read_node_set(AbaqusReading& in, const DeckKeyword& keyword);
void read_element_set(AbaqusReading& in, const DeckKeyword& keyword);
void read_surface(AbaqusReading& in, const DeckKeyword& keyword);

// Nodes and elements that are generated rather than listed.
void read_ngen(AbaqusReading& in, const DeckKeyword& keyword);
void read_nfill(AbaqusReading& in, const DeckKeyword& keyword);
void read_ncopy(AbaqusReading& in, const DeckKeyword& keyword);
void read_elgen(AbaqusReading& in, const DeckKeyword& keyword);
void read_elcopy(AbaqusReading& in, const DeckKeyword& keyword);

// Sections, masses, axes.
void read_solid_section(AbaqusReading& in, const DeckKeyword& keyword);
void read_shell_section(AbaqusReading& in, const DeckKeyword& keyword);
void read_beam_section(AbaqusReading& in, const DeckKeyword& keyword);
void read_beam_general_section(AbaqusReading& in, const DeckKeyword& keyword);
void read_nodal_thickness(AbaqusReading& in, const DeckKeyword& keyword);
void read_distribution(AbaqusReading& in, const DeckKeyword& keyword);
void read_spring(AbaqusReading& in, const DeckKeyword& keyword);
void read_mass(AbaqusReading& in, const DeckKeyword& keyword);
void read_rotary_inertia(AbaqusReading& in, const DeckKeyword& keyword);
void read_orientation(AbaqusReading& in, const DeckKeyword& keyword);
void read_system(AbaqusReading& in, const DeckKeyword& keyword);
void read_transform(AbaqusReading& in, const DeckKeyword& keyword);

// Materials.
void read_material(AbaqusReading& in, const DeckKeyword& keyword);
void read_elastic(AbaqusReading& in, const DeckKeyword& keyword);
void read_density(AbaqusReading& in, const DeckKeyword& keyword);
void read_damping(AbaqusReading& in, const DeckKeyword& keyword);

// Constraints.
void read_coupling(AbaqusReading& in, const DeckKeyword& keyword);
void read_kinematic(AbaqusReading& in, const DeckKeyword& keyword);
void read_distributing(AbaqusReading& in, const DeckKeyword& keyword);
void read_kinematic_coupling(AbaqusReading& in, const DeckKeyword& keyword);
void read_rigid_body(AbaqusReading& in, const DeckKeyword& keyword);
void read_mpc(AbaqusReading& in, const DeckKeyword& keyword);
void read_equation(AbaqusReading& in, const DeckKeyword& keyword);
void read_tie(AbaqusReading& in, const DeckKeyword& keyword);
void read_surface_interaction(AbaqusReading& in, const DeckKeyword& keyword);
void read_surface_behavior(AbaqusReading& in, const DeckKeyword& keyword);
void read_contact_pair(AbaqusReading& in, const DeckKeyword& keyword);
/// Turns contact pairs that cannot open into ties, once all interactions are known.
void add_tied_contacts(AbaqusReading& in);
void read_distributing_coupling(AbaqusReading& in, const DeckKeyword& keyword);

/// The set with this name in a map of sets, created if missing.
AbaqusSet& set_called(std::map<std::string, AbaqusSet>& sets, const std::string& name);

/// Orthonormal axes 1, 2, 3 as columns from a point on axis 1 and one in the plane of axes 1 and 2;
/// none if these lie on one line.
std::optional<Eigen::Matrix3d> axes_from(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// Three numbers of a row; empty cells are 0.
Eigen::Vector3d read_vector(const AbaqusLines& lines, const DeckRow& row, std::size_t first,
                            const char* what);

}  // namespace buckens::mesh_io
