// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "buckens/body/reduced_basis.h"

namespace buckens::body {

/// The body in the coordinates η: ZᵀMZ = 1 and ZᵀKZ diagonal, inertia integrals and marker rows
/// projected (W_ab → ZᵀW_ab Z, c_ab → Zᵀc_ab, N → N Z). It replaces the full one; mesh() and
/// nodal() of the result lead back to the nodes.
///
/// A quasi-static body loses M and damping: K η = load, regardless of rates.
/// @param part full body with all its rows
std::unique_ptr<FlexiblePart> reduce(const std::string& body, const FlexiblePart& part,
                                     const ReducedBasis& basis);

}  // namespace buckens::body
