// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/spatial/marker_motion.h"
#include "buckens/spatial/touch_surface.h"

namespace buckens::spatial {

struct TouchPlace;

/// Number of directions around a face in which places of two boxes are looked for.
inline constexpr int kBoxDirections = 8;

/// Where two boxes touch: a corner of the area in which a face of one overlaps the other, or where
/// two edges cross.
///
/// Such a corner is a corner of either box at a face of the other, or a crossing of two edges; its
/// gap is exact. Places go by direction: place k is the corner of the area that lies furthest in
/// the k-th of eight directions around the face, in planar models of two. As the area changes,
/// places so move on to corners next to them.
/// @param direction 0 … 7; in planar models 0 or 1
/// @param out all but its directions is written
void look_at_boxes(const TouchSurface& first, const TouchSurface& second, int direction,
                   const MarkerMotion& F, const MarkerMotion& M, TouchPlace& out);

}  // namespace buckens::spatial
