// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "buckens/loads/polyhedron.h"
#include "buckens/spatial/rigid_touch.h"

namespace buckens::loads {

/// Up to so many faces of a mesh have places of their own for either rim of a cylinder.
inline constexpr std::size_t kMostSingleFaces = 24, kFaceGroups = 24;

/// All places in which a cylinder of M touches a surface of triangles of F: the four below, and
/// points that stay in its ends, over faces. Theory: docs/theory/25-contact.md §4.
spatial::TouchFinders cylinder_over_mesh(const std::shared_ptr<const Polyhedron>& mesh,
                                         const spatial::TouchSurface& cylinder);

/// The lowest point of either rim over each face, or over the nearest of a group of them.
spatial::TouchFinders rims_over_faces(const std::shared_ptr<const Polyhedron>& mesh,
                                      const spatial::TouchSurface& cylinder);

/// Sharp corners at the ends and the side, each of them or groups.
spatial::TouchFinders corners_at_cylinder(const std::shared_ptr<const Polyhedron>& mesh,
                                          const spatial::TouchSurface& cylinder);

/// Sharp edges, or groups of them, at the side or the rims: two places of each.
spatial::TouchFinders edges_at_cylinder(const std::shared_ptr<const Polyhedron>& mesh,
                                        const spatial::TouchSurface& cylinder);

/// The greatest length in a cylinder [m].
double greatest_length(const spatial::TouchSurface& cylinder);

/// The box around a disc. @param axis unit vector
Eigen::AlignedBox3d box_around_disc(const Eigen::Vector3d& middle, const Eigen::Vector3d& axis,
                                    double radius);

}  // namespace buckens::loads
