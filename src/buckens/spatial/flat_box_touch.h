// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/spatial/marker_motion.h"
#include "buckens/spatial/touch_surface.h"

namespace buckens::spatial {

struct TouchPlace;

/// Where two boxes of a planar model touch: either end of the line along which a side of one
/// overlaps one of the other. Such an end is a corner of either box at the side of the other; its
/// gap is exact.
/// @param direction 0 or 1: which end
/// @param out all but its directions is written
void look_at_flat_boxes(const TouchSurface& first, const TouchSurface& second, int direction,
                        const MarkerMotion& F, const MarkerMotion& M, TouchPlace& out);

}  // namespace buckens::spatial
