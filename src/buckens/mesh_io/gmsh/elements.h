// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "buckens/fem/mesh/cell_kind.h"

namespace buckens::mesh_io {

/// Gmsh's representation of one element shape.
struct GmshElement {
  int type = 0;  ///< Gmsh's number
  const char* name = "";
  int num_nodes = 0;
  fem::CellKind kind = fem::CellKind::tet4;
  /// Gmsh's index of each of our nodes; empty: the same order. Shorter than num_nodes if nodes
  /// within faces and volumes are left out.
  std::vector<int> places;
};

/// Null for types that are not known here.
const GmshElement* gmsh_element(int type);

/// How our shapes are written.
const GmshElement& gmsh_element(fem::CellKind kind);

/// Names of known types, for messages.
std::string gmsh_element_names();

}  // namespace buckens::mesh_io
