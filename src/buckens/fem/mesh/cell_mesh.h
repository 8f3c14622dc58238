// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "buckens/fem/structure.h"

namespace buckens::fem {

/// Points by name.
using NamedPoints = std::vector<std::pair<std::string, int>>;

/// Hexahedral cells with points at half steps: every cell has 27 of them, from which elements of
/// every kind take their nodes. So mid-side nodes are on the true surface.
struct CellMesh {
  std::vector<Eigen::Vector3d> points;  ///< model axes [m]
  /// Point (i, j, k) of a cell, 0…2 each, at i + 3 j + 9 k; right-handed axes.
  std::vector<std::array<int, 27>> cells;
  std::vector<FaceSet> face_sets;  ///< `element` is the index of the cell, `face` as for hexahedra
  NamedPoints names;
};

/// Whether a point becomes a node: corners are at even positions, mid-side nodes of hex20 have one
/// odd index, the diagonals of tet10 reach every position, those of wedge15 are across the third
/// axis, and pyramids meet in the middle.
/// @param place indices of half steps along the three axes of the cells
bool is_node(SolidKind kind, const std::array<int, 3>& place);

/// Hexahedra 1, wedges 2, tetrahedra and pyramids 6.
int elements_per_cell(SolidKind kind);

/// What a mesh generator added to a structure.
struct GeneratedMesh {
  int first_node = 0;
  NamedPoints names;  ///< named points of the cells that became nodes
};

/// Replaces cells by elements: one hexahedron, two wedges, six tetrahedra or six pyramids each.
/// Points without an element are left out, the others keep their order; face sets go to the
/// structure.
///
/// The tetrahedra meet in the corner of a cell with the lowest number, and so does the diagonal of
/// each face: both cells at a face choose the same (Dompierre et al., 1999).
GeneratedMesh add_cells(Structure& structure, const CellMesh& mesh, const SolidForm& form,
                        const Material& material);

}  // namespace buckens::fem
