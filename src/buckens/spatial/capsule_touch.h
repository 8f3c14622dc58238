// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "buckens/spatial/rigid_touch.h"

namespace buckens::spatial {

/// Where the axis of a capsule of M is nearest to the edges of a box of F, one finder for each; in
/// planar models to its four corners. The ends of the capsule are places of their own.
TouchFinders capsule_over_edges(const TouchSurface& box, const TouchSurface& capsule);

/// Where the axis of a capsule of M is nearest to a rim of a cylinder of F, on one side of the
/// place where it is nearest to the cylinder's axis; where nothing is nearest there, its end.
/// @param end 1 or −1: rim along the cylinder's axis, @param towards 1 or −1: side along the
/// capsule's
std::shared_ptr<const TouchFinder> capsule_over_rim(const TouchSurface& cylinder,
                                                    const TouchSurface& capsule, double end,
                                                    double towards);

/// Where the axis of a capsule of M is nearest to the curved side of a cylinder of F: across both
/// axes, or at the rim of one end.
std::shared_ptr<const TouchFinder> capsule_across_cylinder(const TouchSurface& cylinder,
                                                           const TouchSurface& capsule);

}  // namespace buckens::spatial
