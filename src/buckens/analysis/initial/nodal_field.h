// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "buckens/model/build/build_model.h"

namespace buckens::analysis {

/// Rigid motion in a formula field over a body: that of one part minus that of the whole.
struct RigidShare {
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< of the part's mass centre, model axes
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();     ///< model axes
};

/// The variables of a body from formulas evaluated at its nodes.
/// @param laws for x, y, z and the rotations about them, in model axes
linalg::Vector nodal_field(const body::Body& part,
                           const std::array<const model::PositionLaw*, 6>& laws);

/// Removes rigid motion from the fields over the parts of a whole body, one field per part.
/// @return what remains for the frame of each part after subtracting the rigid motion of the whole,
/// which carries its linear and angular momentum; zeros for a body of one part
std::vector<RigidShare> sieve_field(const model::Model& model, const model::WholeBody& whole,
                                    std::vector<linalg::Vector>& fields);

}  // namespace buckens::analysis
