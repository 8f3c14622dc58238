// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "buckens/fem/fe_model.h"
#include "buckens/linalg/matrix_types.h"

namespace buckens::body {

/// Rigid motions Φ = [Φ_t Φ_r] of the nodal variables about the mass centre: unit translations
/// along and unit rotations about the body axes, FM (4), (5). Shape n×6.
///
/// Spans every rigid motion of the kept nodal DOF; a column is zero if the DOF cannot represent it
/// (a straight pin-jointed bar about its axis).
/// @param node_positions in model axes [m]
/// @param com mass centre in model axes [m]
linalg::Matrix rigid_modes(const std::vector<Eigen::Vector3d>& node_positions,
                           const fem::DofMap& dofs, const Eigen::Vector3d& com);

/// Verifies K Φ = 0: rigid motion must not strain the mesh.
///
/// Tolerance: |KΦ| ≤ 1e-9 |K| |Φ| column by column, far above rounding (about 1e-14 for sensible
/// meshes) and far below any spring to ground.
/// @throws ModelError naming the body, the rigid mode and the node where the residual is largest
void check_stiffness_is_free(const std::string& body, const linalg::SymmetricMatrix& K,
                             const linalg::Matrix& Phi, const fem::FeModel& fe);

}  // namespace buckens::body
