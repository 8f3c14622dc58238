// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "buckens/fem/element/dof_map.h"
#include "buckens/fem/fe_model.h"
#include "buckens/linalg/matrix_types.h"

namespace buckens::fem {

/// Mass and stiffness of a free body as assembled by another program, with the positions and
/// variables of its nodes. In SI units.
struct BodyMatrices {
  std::vector<std::int64_t> numbers;  ///< of the nodes in that program
  std::vector<Node> nodes;
  DofMap dofs;             ///< three displacements per node, and three or no rotations
  linalg::SparseMatrix M;  ///< symmetric, both triangles
  linalg::SparseMatrix K;
  linalg::SparseMatrix C;  ///< damping; empty: none
};

/// Rayleigh damping of the model file, C = α M + β K, used instead of a damping matrix.
struct RayleighFactors {
  double mass = 0;                 ///< α [1/s]
  double stiffness = 0;            ///< β [s]
  bool damps_held_motion = false;  ///< see FeModel
};

/// Makes a body without elements from matrices.
///
/// The inertia integrals follow from M as matrix_integrals() says. A damping matrix may contain a
/// part α M; the rest must not resist rigid motion.
/// @throws ModelError if a matrix has negative 2×2 minors, M is not that of a body free in space, K
/// is zero, or K or the rest of C resists a rigid motion (naming it)
FeModel assemble(const BodyMatrices& body, const RayleighFactors& damping);

/// The inertia integrals that correspond to a mass matrix.
///
/// Let X be the 3×3 block of M that couples the translations of nodes I and J. The block of W_ab
/// there is ½(X E_ab + E_ab X) with E_ab = e_a e_bᵀ, which is m E_ab for X = m 1. That is exact for
/// solids and for lumped masses, whose three directions share their shape functions; for beams and
/// shells, products of two directions get the mean of the masses of the two. A block X between
/// translations and rotations becomes E_ab X. A block between rotations is interpreted as points at
/// ρ from the node that move by θ × ρ, with ∫ρρᵀdm = ½ tr(X) 1 − Xᵀ: exact for discs and other
/// masses with rotary inertia on nodes, and for straight beams, whose deflections by nodal
/// rotations are those of points along the beam. Σ W_aa = M always. c_ab = ∫ s0_a g_b dm has the
/// nodal positions in M, and for rotations the same points; then c_ab − c_ba = M Φ_r exactly. Mass,
/// mass centre and J0 come from ΦᵀMΦ with the rigid motions Φ.
ShapeIntegrals matrix_integrals(const BodyMatrices& body);

}  // namespace buckens::fem
