// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/loads/contact_pair.h"
#include "buckens/spatial/touch_surface.h"

namespace buckens::loads {

/// Distance of a point from the surface of a shape, negative inside [m]; exact.
/// @param point in axes of the shape, @param normal gradient there, out of the solid
double distance_from(const ContactShape& shape, const Eigen::Vector3d& point,
                     Eigen::Vector3d& normal);

/// The surface of any shape but a mesh.
spatial::TouchSurface touch_surface(const ContactShape& shape);

}  // namespace buckens::loads
