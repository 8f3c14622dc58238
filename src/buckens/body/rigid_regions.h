// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "buckens/body/body.h"
#include "buckens/fem/constraint/node_links.h"

namespace buckens::body {

/// Nodes of a mesh that move as a rigid body.
struct RigidRegion {
  std::string name;
  std::vector<int> nodes;                            ///< not collinear
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< where its variables are, model axes [m]
};

/// A body whose links are solved.
struct LinkedPart {
  std::unique_ptr<FlexiblePart> part;
  std::string note;  ///< on nodes that follow others since nothing held them; may be empty
};

/// The body without the variables that links inside its mesh make dependent: d = T x,
/// sparse, see fem/constraint/elimination.h. The variables of a rigid region are those of one more
/// node at its centre, three translations and three rotations, with u_i = u + θ × (x_i − centre).
///
/// M, K, C, c_ab and W_ab become Tᵀ(·)T. The scalar mass matrix keeps its entries between nodes
/// that T does not affect; the others go to W_ab. The result has the mass and the six rigid motions
/// of the whole; mesh() and nodal() lead back to all nodes.
/// Motions of nodes that move neither mass nor an element follow those of nodes around, see
/// loose_motions.h.
/// @param part full body without marker rows
/// @throws ModelError naming two regions with common nodes, a link that would ground the body, or a
/// massless node that can move where there is nothing for it to follow
LinkedPart with_links(const std::string& body, FlexiblePart& part,
                      const std::vector<RigidRegion>& regions, const fem::NodeLinks& links = {});

}  // namespace buckens::body
