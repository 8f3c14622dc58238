// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "buckens/loads/contact_pair.h"

namespace buckens::loads {

/// Convex solids that capsules touch along a line.
constexpr bool touches_along_lines(ContactShape::Kind first) {
  using enum ContactShape::Kind;
  return first == capsule || first == box || first == cylinder;
}

/// Where a capsule touches a convex solid: two spots that share the force of the overlap δ(s) along
/// its axis, which has the energy K ∫ δ³ ds/∫ δ ds.
///
/// On a flat face that is what springs K at both ends have, in between it passes over edges without
/// a jump. Crossed capsules have K. Both forces together are the exact derivative of the
/// energy. Theory: docs/theory/25-contact.md §1, (C11) and (C12).
/// @param r middle of the capsule in axes of the first [m], @param R its orientation in the first
/// @param spots two of them, axes of the first
void find_line_spots(const ContactShape& first, const ContactShape& capsule,
                     const Eigen::Vector3d& r, const Eigen::Matrix3d& R,
                     std::span<ContactSpot, 2> spots);

}  // namespace buckens::loads
