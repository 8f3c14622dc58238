// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/fem/solid/face_set.h"
#include "buckens/fem/structure.h"

namespace buckens::fem {

/// Integrals over the surface of the nodes of a shell, node by node; n points away from the loaded
/// side. A pressure acts where the nodes are, regardless of offset and thickness.
FaceIntegrals shell_side_integrals(const ShellBlock& shells, const std::vector<Node>& nodes,
                                   const ShellSide& side);

/// ∫ w u dV of a shell as rows over its nodes: displacements get ∫ N w dz dA, rotations of the
/// director n the contribution of material points above and below the nodes.
struct ShellShares {
  std::vector<int> nodes;
  Eigen::VectorXd translation;  ///< ∫ N w dV
  /// Column i: ∫ N w z dV times the director; θ_i × it is added to u of the material points.
  Eigen::Matrix3Xd arm;
};
/// @param per_mass w = ρ, else 1
ShellShares shell_shares(const ShellBlock& shells, const std::vector<Node>& nodes, int element,
                         bool per_mass);

}  // namespace buckens::fem
