// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "buckens/body/body.h"

namespace buckens::body {

/// Vectors in which a body may deform, d = Z η, and what they leave.
struct ReducedBasis {
  linalg::Matrix Z;       ///< n×r, M-orthonormal, K-orthogonal, free of rigid motion
  linalg::Vector omega;   ///< √(zᵀKz) of each [rad/s], ascending
  int num_modes = 0;      ///< free vibrations in it
  int num_residuals = 0;  ///< static corrections in it
};

/// The lowest free vibrations of a body, with the deformations that unit interface loads cause
/// beyond them (inertia-relief residuals) if asked for.
///
/// Modes and residuals carry no rigid motion, so a body reduced to them needs no sieve. Residuals
/// make the answer to slow interface loads that of the full mesh whatever the number of modes.
/// @param modes wanted; fewer come back where the body has fewer
/// @param length scale that makes rotations and translations comparable [m]
/// @throws ModelError naming the body if its mesh is a mechanism
ReducedBasis free_free_basis(const std::string& body, const FlexiblePart& part, int modes,
                             bool static_correction, double length);

/// What a body without elastic inertia can be deformed to: the answers K⁺ to unit interface loads
/// and to the six centrifugal load patterns, with the lowest free vibrations as further shapes if
/// asked for. Exact for all loads that do not depend on the deformation.
/// @param modes 0: none
ReducedBasis quasi_static_basis(const std::string& body, const FlexiblePart& part, int modes,
                                double length);

/// The body in the coordinates η: ZᵀMZ = 1 and ZᵀKZ diagonal, inertia integrals and marker rows
/// projected (W_ab → ZᵀW_ab Z, c_ab → Zᵀc_ab, N → N Z). It takes the place of the full one; mesh()
/// and nodal() of the result lead back to the nodes.
///
/// For a quasi-static body M and damping are then dropped and W_ab is replaced by its symmetric
/// part: the Lagrangian with T = ½ m ṙ² + ½ ω·J(d)ω, in which deformation has no rates.
/// @param part full body with all its rows
std::unique_ptr<FlexiblePart> reduce(const std::string& body, const FlexiblePart& part,
                                     const ReducedBasis& basis);

}  // namespace buckens::body
