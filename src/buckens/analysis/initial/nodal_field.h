// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "buckens/model/build/build_model.h"

namespace buckens::analysis {

/// What a formula field over a body says of its rigid motion: of one part, less that of the whole.
struct RigidShare {
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< of the part's mass centre, model axes
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();     ///< model axes
};

/// The variables of a body as formulas give them at its nodes.
/// @param laws for x, y, z and the rotations about them, in model axes
linalg::Vector nodal_field(const body::Body& part,
                           const std::array<const model::PositionLaw*, 6>& laws);

/// Takes rigid motion out of the fields over the parts of a whole body, one field per part.
/// @return what is left of it for the frame of each part once the rigid motion of the whole, which
/// carries its linear and angular momentum, is taken off; zeros for a body of one part
std::vector<RigidShare> sieve_field(const model::Model& model, const model::WholeBody& whole,
                                    std::vector<linalg::Vector>& fields);

}  // namespace buckens::analysis
