// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/fem/element/block.h"
#include "buckens/fem/fe_model.h"
#include "buckens/fem/structure.h"

namespace buckens::fem {

/// Nodes that carry a frame, each weighted with its share of the surface.
struct NodeRegion {
  std::vector<int> nodes;   ///< ascending
  Eigen::VectorXd weights;  ///< shares, not negative, sum 1
  double area = 0;          ///< of the element faces in the region [m²]; 0: there is none
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< weighted mean position, model axes [m]
  /// Σ w (|r|² 1 − r rᵀ) with r from the centre [m²]: how well the nodes define a rotation.
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();

  /// Whether the nodes define a rotation about every axis: they are neither coincident nor
  /// collinear.
  bool turns() const;
};

/// The nodes of a set of faces, weighted by their areas.
NodeRegion face_region(const Structure& structure, const FaceSet& faces);

/// Any nodes. Weights are areas of those surface faces and shells whose nodes are all among them;
/// if there are none, all nodes count equally.
NodeRegion node_region(const Structure& structure, std::vector<int> nodes);

/// Surface faces of the mesh (those of one solid element only) whose nodes are all among the given
/// ones.
std::vector<ElementFace> faces_within(const Structure& structure, const std::vector<int>& nodes);

/// Nodes with given weights, each node once.
/// @param weights positive, as many as nodes
NodeRegion weighted_region(const std::vector<Node>& all, const std::vector<int>& nodes,
                           const std::vector<double>& weights);

/// The same region with other node numbers, such as those of a part of the mesh.
NodeRegion renumbered(const NodeRegion& region, const std::vector<int>& nodes);

/// Displacement and rotation of a frame at `at` that best fit the displacements of the nodes, Σ w
/// |u_i − u − θ × (x_i − at)|² → min:
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
