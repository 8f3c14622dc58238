// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "buckens/fem/mesh/cell_kind.h"

namespace buckens::mesh_io {

/// What elements of a type mean for a body.
enum class AbaqusRole {
  solid,
  shell,
  beam,
  bar,
  mass,            ///< MASS
  rotary_inertia,  ///< ROTARYI
  spring,          ///< SPRING2, SPRINGA
  plane,           ///< CPS, CPE: ignored beside others, shells if there are no others
  left_out,        ///< dashpots, connectors, rigid and surface elements
};

/// Whether elements become elements of the body.
constexpr bool is_kept(AbaqusRole role) {
  return role == AbaqusRole::solid || role == AbaqusRole::shell || role == AbaqusRole::beam ||
         role == AbaqusRole::bar;
}

/// An element type of Abaqus or CalculiX.
struct AbaqusElementType {
  std::string_view name;
  AbaqusRole role;
  fem::CellKind kind;
  int num_nodes;               ///< in the deck; −1: any number
  std::string_view becomes;    ///< what it becomes if not obvious
  bool shear_flexible = true;  ///< of beams
};

/// Null if the type is not known.
const AbaqusElementType* find_abaqus_element(std::string_view name);

/// Corners of the faces S1, S2, … of a solid, as indices into its nodes, counter-clockwise seen
/// from inside as listed by Abaqus; empty for other shapes.
std::span<const std::vector<int>> abaqus_faces(fem::CellKind kind);

/// Corners of the edges with mid-side nodes, in the order of these nodes, which follow the corners;
/// empty for linear shapes.
std::span<const std::array<int, 2>> abaqus_edges(fem::CellKind kind);

}  // namespace buckens::mesh_io
