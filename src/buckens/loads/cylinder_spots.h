// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "buckens/loads/contact_pair.h"

namespace buckens::loads {

/// Solids that the volume of a cylinder reaches into.
constexpr bool touches_cylinder_by_volume(ContactShape::Kind first) {
  return first == ContactShape::Kind::box || first == ContactShape::Kind::cylinder;
}

/// Number of spots of a cylinder on one of these.
inline constexpr std::size_t kCylinderSpots = 8;

/// Where a cylinder touches a box or a cylinder: spots that stand for springs spread over the
/// volume that both have in common, with the energy 4 K/Ā ∫ p dV, p being the depth below the
/// nearest side of the first and Ā the area of the smaller one's face. So an end that lies on a
/// face has the energy of springs over its area, and forces are the derivative of an energy in any
/// position.
///
/// Spots 0 to 3 stand for the flat face with the largest volume below it, the others for what is
/// nearest to other faces or to the curved side. Theory: docs/theory/25-contact.md §1, (C13).
/// @param r middle of the cylinder in axes of the first [m], @param R its orientation in the first
/// @param spots axes of the first
void find_cylinder_spots(const ContactShape& first, const ContactShape& cylinder,
                         const Eigen::Vector3d& r, const Eigen::Matrix3d& R,
                         std::span<ContactSpot, kCylinderSpots> spots);

}  // namespace buckens::loads
