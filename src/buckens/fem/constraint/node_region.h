// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/fem/element/block.h"
#include "buckens/fem/fe_model.h"
#include "buckens/fem/structure.h"

namespace buckens::fem {

/// Nodes that carry a frame together, each with its share of the surface.
struct NodeRegion {
  std::vector<int> nodes;   ///< ascending
  Eigen::VectorXd weights;  ///< shares, not negative, sum 1
  double area = 0;          ///< of the element faces in the region [m²]; 0: none lies in it
  Eigen::Vector3d centre =
      Eigen::Vector3d::Zero();  ///< weighted mean of the places, model axes [m]
  /// Σ w (|r|² 1 − r rᵀ) with r from the centre [m²]: how well the nodes hold a rotation.
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();

  /// Whether the nodes tell a rotation about every axis: they lie neither in one point nor on one
  /// line.
  bool turns() const;
};

/// The nodes of a set of faces, weighted by the area that belongs to each.
NodeRegion face_region(const Structure& structure, const FaceSet& faces);

/// Any nodes. Their weights are areas of those faces on the surface of the mesh and of those shells
/// all of whose nodes are among them; where there are none all nodes count alike.
NodeRegion node_region(const Structure& structure, std::vector<int> nodes);

/// Faces that one solid element only has, the surface of the mesh, and whose nodes are all among
/// the given ones.
std::vector<ElementFace> faces_within(const Structure& structure, const std::vector<int>& nodes);

/// Nodes with given weights; each node once.
/// @param weights positive, as many as nodes
NodeRegion weighted_region(const std::vector<Node>& all, const std::vector<int>& nodes,
                           const std::vector<double>& weights);

/// The same region with other node numbers, for instance in a part of the mesh.
NodeRegion renumbered(const NodeRegion& region, const std::vector<int>& nodes);

/// Displacement and rotation of a frame at `at` that fit those of the nodes best, Σ w |u_i − u −
/// θ × (x_i − at)|² → min:
///
///     θ = S⁻¹ Σ w_i r_i × u_i,   u = Σ w_i u_i + θ × (at − centre),   r_i = x_i − centre
///
/// with S the spread. Rigid motion of the mesh is followed exactly, and a force on the frame
/// becomes nodal forces with the same resultant and moment. Without turns() there are no rotation
/// rows, and u is the mean wherever `at` lies.
PointRows region_rows(const std::vector<Node>& nodes, const DofMap& dofs, const NodeRegion& region,
                      const Eigen::Vector3d& at);
PointRows region_rows(const FeModel& fe, const NodeRegion& region, const Eigen::Vector3d& at);

}  // namespace buckens::fem
