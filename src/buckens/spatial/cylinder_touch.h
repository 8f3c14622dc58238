// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "buckens/spatial/rigid_touch.h"

namespace buckens::spatial {

/// All places in which a cylinder of M can touch a box of F. Each is a pair of points of both: the
/// lowest points of the rims over faces, points that stay on the ends, corners at the cylinder, its
/// side and its rims over edges. Of a corner and its opposite, or an edge and its, the nearer one.
TouchFinders cylinder_over_box(const TouchSurface& box, const TouchSurface& cylinder);

/// All places in which two cylinders can touch: rims over ends, sides and rims of the other,
/// points that stay on the ends, and where both sides cross.
TouchFinders cylinder_over_cylinder(const TouchSurface& first, const TouchSurface& second);

}  // namespace buckens::spatial
