// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "buckens/loads/contact_mesh.h"
#include "buckens/loads/contact_pair.h"

namespace buckens::loads {

/// Number of spots of two meshes: three for each way that normals can point along the axes of the
/// first.
inline constexpr std::size_t kMeshSpots = 18;

/// Where two meshes touch: springs spread over the surface of the smaller one, or of both where
/// they are alike, are pushed out of the other one by their depth below its surface. The forces are
/// the derivative of the energy 4 K/Ā ½ ∫ δ² dA in any position, Ā being a sixth of the smaller
/// surface.
///
/// Three spots stand for the forces along each way: a normal n belongs to those of its components,
/// with the shares nᵢ², whose sum is one. So a spot keeps its number as bodies move, and nothing
/// jumps from one to the next. Together they have the force and the moment exactly.
/// Theory: docs/theory/25-contact.md §6, (C16).
/// @param r origin of the second in axes of the first [m], @param R its orientation in the first
void find_mesh_spots(const ContactMesh& first, const ContactMesh& second, const Eigen::Vector3d& r,
                     const Eigen::Matrix3d& R, std::span<ContactSpot, kMeshSpots> spots);

}  // namespace buckens::loads
