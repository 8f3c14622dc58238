// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "buckens/body/body.h"

namespace buckens::body {

/// Nodes of a mesh that move as a rigid body.
struct RigidRegion {
  std::string name;
  std::vector<int> nodes;                            ///< not on one line
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< where its variables are, model axes [m]
};

/// The body with the variables of each region replaced by one node with six, three translations and
/// three rotations at its centre: d = T x with u_i = u + θ × (x_i − centre), sparse.
///
/// M, K, C, c_ab and W_ab become Tᵀ(·)T. The scalar mass matrix keeps its entries between nodes
/// outside the regions; those that a region takes part in stand in W_ab. The result has the mass
/// and the six rigid motions of the whole; mesh() and nodal() lead back to all nodes.
/// @param part full body without marker rows
/// @throws ModelError naming two regions that have nodes in common
std::unique_ptr<FlexiblePart> with_rigid_regions(const std::string& body, FlexiblePart& part,
                                                 const std::vector<RigidRegion>& regions);

}  // namespace buckens::body
