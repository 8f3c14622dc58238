// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "buckens/base/source_location.h"
#include "buckens/fem/structure.h"

namespace buckens::model {

/// Beams, bars and shells of a planar model have only in-plane variables and must be parallel to
/// the plane. Solids may be anywhere.
/// @param normal of the plane, in model axes of the body
/// @throws InputError naming the first element that leaves the plane, and by how much
void require_flat(const std::string& body, const SourceLocation& where,
                  const fem::Structure& structure, const Eigen::Vector3d& normal);

}  // namespace buckens::model
