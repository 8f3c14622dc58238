// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "buckens/loads/contact_pair.h"
#include "buckens/spatial/marker_motion.h"

namespace buckens::loads {

/// The box along the world's axes around a shape; unbounded shapes have an infinite one.
Eigen::AlignedBox3d bounding_box(const ContactShape& shape, const spatial::MarkerMotion& at);

/// Appends all pairs of boxes that overlap, the lower number first: sweep and prune along the axis
/// over which the boxes are spread most. Infinite boxes are compared with all others.
///
/// The cost is that of sorting, and of the pairs that overlap along that axis alone: of n bodies
/// heaped up in space these are about n^(5/3).
void find_overlapping(std::span<const Eigen::AlignedBox3d> boxes,
                      std::vector<std::pair<int, int>>& pairs);

}  // namespace buckens::loads
