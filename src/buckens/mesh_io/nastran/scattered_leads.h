// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "buckens/fem/mesh/imported_mesh.h"

namespace buckens::mesh_io {

/// One component of a node's motion.
struct NodeComponent {
  int node = 0;
  bool is_rotation = false;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
};

/// A rigid body that six components of several nodes place, whose other components are free: the
/// followers as equations in these six.
///
/// Component i is gᵢᵀ r, with r the translation and the rotation of the body at one place. The six
/// that lead make up G, so a follower f is fᵀ G⁻¹ times those that lead.
/// @param followers along the axes of the mesh
/// @return whether the leading components place the body; if not, nothing is added
bool add_led_components(const std::vector<NodeComponent>& leads,
                        const std::vector<NodeComponent>& followers,
                        const std::vector<Eigen::Vector3d>& positions, int line,
                        fem::ImportedMesh& mesh);

/// Takes away equations that turn a node at which nothing has rotations: neither a beam nor a
/// shell, an inertia, nor another link.
/// @param places of equations that say no more than what their first component is
/// @return how many
int drop_idle_rotations(const std::vector<std::size_t>& places, fem::ImportedMesh& mesh);

}  // namespace buckens::mesh_io
