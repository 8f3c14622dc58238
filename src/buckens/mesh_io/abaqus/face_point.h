// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

namespace buckens::mesh_io {

/// The point of a face or an edge that is nearest to a given one.
struct FacePoint {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  double distance = 0;
  Eigen::VectorXd weights;  ///< of the nodes: Σ weight = 1, Σ weight × node = point
  /// Derivatives of the weights along the two parameters; those of an edge have one column.
  Eigen::MatrixXd slopes;
};

/// Nearest point of a line (2 or 3 nodes), triangle (3 or 6, see is_edge) or quadrilateral (4 or
/// 8), in the shape functions of the nodes. Corners come first, then those at mid-sides, the first
/// between the corners 1 and 2. Found by Gauss-Newton steps kept within the face: exact on flat
/// faces, approximate on curved ones.
/// @param nodes columns are the positions of the nodes
FacePoint nearest_on_face(const Eigen::Matrix3Xd& nodes, bool is_edge, const Eigen::Vector3d& x);

/// The small rotation ω of a face as a linear map of the displacements of its nodes, 3 × 3 per node
/// side by side: exact for rigid motion. Its normal rotates with the tangents, and about the normal
/// it is the mean rotation of the two tangents.
/// @param slopes see FacePoint; must have two columns
Eigen::Matrix3Xd face_rotation(const Eigen::Matrix3Xd& nodes, const Eigen::MatrixXd& slopes);

}  // namespace buckens::mesh_io
