// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "buckens/loads/contact_pair.h"

namespace buckens::loads {

/// Where two boxes touch: four spots that stand for the whole area in which a face of one overlaps
/// the other, or one where two edges cross.
///
/// The overlap δ is linear over the area, and the spots lie so that sums over them are the
/// integrals of δ, of its moments and of δ² over it, ContactSpot::share being the ratio
/// of the area to the mean face of the smaller box. Forces so change continuously as corners pass
/// edges. Theory: docs/theory/25-contact.md §1.
/// @param r middle of the second in axes of the first [m], @param R its orientation in the first
/// @param spots four of them, axes of the first
void find_box_spots(const ContactShape& first, const ContactShape& second, const Eigen::Vector3d& r,
                    const Eigen::Matrix3d& R, std::span<ContactSpot, 4> spots);

}  // namespace buckens::loads
