// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "buckens/fem/fe_model.h"
#include "buckens/fem/structure.h"
#include "buckens/spatial/plane.h"

namespace buckens::fem {

/// Forms the constant matrices and the inertia integrals of a body.
///
/// Nodes of beams have six variables, nodes that only bars and solids use three. In planar models
/// the out-of-plane displacement and the two rotations about in-plane axes are left out, except in
/// a mesh with solids, which extends out of the plane. Two passes: mass and mass centre, then
/// everything measured from the mass centre.
/// @param planar plane of the model in model axes
/// @throws ModelError naming the node or element: unused nodes, unconnected parts,
/// zero lengths, constants that are not positive, no mass at all, different
/// `damping_mass`
FeModel assemble(const Structure& structure, std::optional<spatial::Plane> planar = std::nullopt);

}  // namespace buckens::fem
