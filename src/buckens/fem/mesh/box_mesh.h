// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "buckens/fem/mesh/cell_mesh.h"

namespace buckens::fem {

/// A regular block of solid elements, edges parallel to the model axes.
struct Box {
  Eigen::Vector3d from = Eigen::Vector3d::Zero();  ///< corner with the smallest coordinates [m]
  Eigen::Vector3d size = Eigen::Vector3d::Ones();  ///< edge lengths [m], positive
  std::array<int, 3> divisions = {1, 1, 1};        ///< elements along x, y, z

  /// Number of the node at grid position (i, j, k), counted from 0: x fastest, then y, then z.
  int node(const std::array<int, 3>& place) const {
    return place[0] + (divisions[0] + 1) * (place[1] + (divisions[1] + 1) * place[2]);
  }
};

/// A named node of a box, by its grid position.
struct NamedGridPlace {
  std::string name;
  std::array<int, 3> place;
};

/// Names of nodes of a box: `node_first` and `node_last`, the corners `corner_000` … `corner_111`
/// (digits for x, y, z: 0 the lower, 1 the upper end), and, where there is a node, the face centres
/// `face_x0` … `face_z1` and the `centre`.
std::vector<NamedGridPlace> named_places(const Box& box);

/// The cells of a box with faces `x0`, `x1`, `y0`, `y1`, `z0`, `z1` and the points of
/// named_places() at half steps.
/// @throws ModelError if a size or a division is not positive
CellMesh box_cells(const Box& box);

/// Adds the nodes and elements of a box.
/// @throws ModelError as box_cells()
GeneratedMesh add_box(Structure& structure, const Box& box, const Material& material,
                      const SolidForm& form);

/// The same with hex8 elements and full integration.
/// @return number of its first node; the others follow in the order of Box::node
int add_box(Structure& structure, const Box& box, const Material& material);

}  // namespace buckens::fem
