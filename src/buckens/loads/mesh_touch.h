// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "buckens/loads/contact_mesh.h"
#include "buckens/spatial/rigid_touch.h"

namespace buckens::loads {

/// Up to so many sharp corners of a mesh are a place each; more are divided into groups.
inline constexpr std::size_t kMostSingleCorners = 96, kCornerGroups = 24;

/// Numbers of points divided into groups so that those of one group are far from each other: of
/// points next to each other that touch at once, or one after the other, each has a place of its
/// own. Each group begins with points that are spread over the whole.
std::vector<std::vector<int>> far_groups(const std::vector<Eigen::Vector3d>& points,
                                         std::size_t most_groups);

/// The corners with which a mesh of M can touch a plane of F: one finder for each, or for each
/// group of them, which finds the lowest, of those at the same height the first.
spatial::TouchFinders plane_touches(const spatial::TouchSurface& plane, const ContactMesh& mesh);

/// Where a sphere of M, or an end of a capsule, is nearest to a mesh of F: one finder for each
/// colour of its patches.
/// @param at centre in axes of its marker [m]
spatial::TouchFinders sphere_touches(const std::shared_ptr<const ContactMesh>& mesh, double radius,
                                     const Eigen::Vector3d& at);

/// All places in which a capsule of M touches a mesh of F: both ends as spheres, its axis at each
/// sharp edge or at the nearest of a group of them, and either half of it at curved patches.
spatial::TouchFinders capsule_touches(const std::shared_ptr<const ContactMesh>& mesh,
                                      const spatial::TouchSurface& capsule);

}  // namespace buckens::loads
