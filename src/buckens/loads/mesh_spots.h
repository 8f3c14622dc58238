// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "buckens/loads/contact_mesh.h"
#include "buckens/loads/contact_pair.h"

namespace buckens::loads {

/// Where a sphere touches a mesh: one spot for each colour of its patches.
/// @param centre in axes of the mesh [m], @param spots ContactMesh::num_colours() of them
void find_sphere_spots(const ContactMesh& mesh, const Eigen::Vector3d& centre, double radius,
                       std::span<ContactSpot> spots);

/// Where a mesh reaches through a plane through the origin: four spots that stand for the area in
/// which its facets are below the plane, as between boxes (loads/box_manifold.h). They have its
/// force and moments exactly, ContactSpot::held is what they lack of its energy.
/// @param normal of the plane, @param r origin of the mesh, @param R its orientation, axes of the
/// plane's marker
void find_plane_spots(const ContactMesh& mesh, const Eigen::Vector3d& normal,
                      const Eigen::Vector3d& r, const Eigen::Matrix3d& R,
                      std::span<ContactSpot, 4> spots);

}  // namespace buckens::loads
