// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "buckens/fem/fe_model.h"
#include "buckens/fem/structure.h"
#include "buckens/spatial/plane.h"

namespace buckens::fem {

/// Makes the constant matrices and the inertia integrals of a body.
///
/// Nodes of beams have six variables, nodes that only bars and solids use three. In planar models
/// the out-of-plane displacement and the two rotations about in-plane axes are left out, except in
/// a mesh with solids: it stretches out of the plane, too.
/// Two passes: mass and mass centre, then everything that is measured from the mass centre.
/// @param planar plane of the model in model axes
/// @throws ModelError naming the node or element: unused nodes, parts that hang together by
/// nothing,
///         zero lengths, constants that are not positive, no mass at all, different `damping_mass`
FeModel assemble(const Structure& structure, std::optional<spatial::Plane> planar = std::nullopt);

}  // namespace buckens::fem
