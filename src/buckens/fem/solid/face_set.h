// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/fem/solid/block.h"

namespace buckens::fem {

/// One face of a solid element.
struct ElementFace {
  int element = 0;  ///< numbered among the solid elements
  int face = 0;     ///< number in SolidTopology::faces
};

/// One side of a shell element.
struct ShellSide {
  int element = 0;           ///< numbered among the shell elements
  bool is_negative = false;  ///< the side that the normal points away from
};

/// Faces of solid elements and sides of shells under one name, such as `x0` of a box or `side` of a
/// cylinder.
struct FaceSet {
  std::string name;
  std::vector<ElementFace> faces;
  std::vector<ShellSide> shells = {};
};

/// Nodes of one face: corners counter-clockwise seen from outside, then mid-side nodes.
std::vector<int> face_nodes(const SolidBlock& solids, const ElementFace& face);

/// All nodes of a set, ascending, each once.
std::vector<int> face_set_nodes(const SolidBlock& solids, const std::vector<ElementFace>& faces);

/// Data of one face for loads and averages, node by node in the order of face_nodes().
struct FaceIntegrals {
  std::vector<int> nodes;
  Eigen::VectorXd area;     ///< ∫ N dA [m²]: a uniform traction's share; corners may be negative
  Eigen::Matrix3Xd normal;  ///< ∫ N n dA [m²], n outwards: a uniform pressure's share is −p times
  Eigen::MatrixXd products;  ///< ∫ N Nᵀ dA [m²]
  /// Shares of the area that are positive for every kind: the diagonal of `products` scaled to the
  /// area (Hinton, Rock, Zienkiewicz, 1976) [m²].
  Eigen::VectorXd positive_area;
};

/// Integrals over a face; exact for plane faces with straight edges.
FaceIntegrals face_integrals(const SolidBlock& solids, const std::vector<Node>& nodes,
                             const ElementFace& face);

}  // namespace buckens::fem
