// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/body/body.h"

namespace buckens::body {

/// Factors that convert quantities of different units to displacements [m], so that they can be
/// compared and no result depends on the unit of length.

/// Per nodal variable of a flexible body's equations: rotations are scaled by the body's size,
/// other coordinates by the largest displacement in their shape.
linalg::Vector coordinate_lengths(const Body& body);

/// Per interface row y = N d of a flexible body: 1 for displacements, `L` for rotations; for a row
/// of a distributed load, from its value when everything moves by 1 m.
Eigen::VectorXd interface_lengths(const Body& body, double L);

}  // namespace buckens::body
