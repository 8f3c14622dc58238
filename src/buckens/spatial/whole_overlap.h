// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/spatial/marker_motion.h"
#include "buckens/spatial/touch_surface.h"

namespace buckens::spatial {

/// Whether two bodies, boxes or cylinders, overlap along a direction by clearly more than they need
/// to, or by less than a place says: then they do not touch across it, even where a point of one is
/// just inside of the other.
/// @param normal from the first to the second, @param gap of the place [m]
bool overlap_needlessly(const TouchSurface& first, const MarkerMotion& F,
                        const TouchSurface& second, const MarkerMotion& M,
                        const Eigen::Vector3d& normal, double gap);

/// Half the extent of a box or cylinder [m].
double least_extent(const TouchSurface& solid);

}  // namespace buckens::spatial
