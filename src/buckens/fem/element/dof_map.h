// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace buckens::fem {

/// A node of the mesh.
struct Node {
  std::string name;                                    ///< empty for nodes created by a division
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< in model axes [m]
};

/// Numbers of the nodal variables d.
///
/// d holds displacements [m] and small rotations [rad] in the axes of the body frame, node by node.
struct DofMap {
  int num_dofs = 0;
  /// Per node: 0…2 translations, 3…5 rotations; −1 where the node has no such variable (rotations
  /// of nodes that only bars use, out-of-plane variables of planar models).
  std::vector<std::array<int, 6>> node_dofs;
};

}  // namespace buckens::fem
