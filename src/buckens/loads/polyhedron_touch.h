// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "buckens/loads/contact_pair.h"
#include "buckens/loads/polyhedron.h"
#include "buckens/spatial/rigid_touch.h"

namespace buckens::loads {

/// Up to so many sharp edges of the body that has fewer have places of their own.
inline constexpr std::size_t kMostSingleEdges = 24, kEdgeGroups = 24;

using spatial::TouchFinders;

/// Boxes of no size, to look for corners by.
std::vector<Eigen::AlignedBox3d> boxes_of(const std::vector<Polyhedron::Corner>& corners);

/// Where sharp corners of one body touch faces of another: one finder for each, or for each group
/// of them.
/// @param size of the body with the corners [m], @param is_second it is M
TouchFinders corners_on_faces(const std::shared_ptr<const Polyhedron>& faces,
                              const std::vector<Polyhedron::Corner>& corners, double size,
                              bool is_second);

/// Where sharp edges of two bodies cross: two finders for each edge of the body that has fewer of
/// them, or for each group of such edges, one towards either end.
TouchFinders edges_across(const std::shared_ptr<const Polyhedron>& first,
                          const std::shared_ptr<const Polyhedron>& second);

/// The surface of a mesh, or the six faces of a box.
std::shared_ptr<const Polyhedron> polyhedron_of(const ContactShape& shape);

/// All places of two boxes of a planar model: corners of either at sides of the other.
TouchFinders flat_box_touches(const ContactShape& first, const ContactShape& second);

/// All places of two surfaces of triangles.
TouchFinders polyhedron_touches(const std::shared_ptr<const Polyhedron>& first,
                                const std::shared_ptr<const Polyhedron>& second);

}  // namespace buckens::loads
