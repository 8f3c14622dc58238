// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "buckens/linalg/matrix_types.h"
#include "buckens/linalg/shared_matrix.h"

namespace buckens::fem {

/// Inertia of elements whose three displacement components share scalar shape functions
/// (solids): W_ab = Ms ⊗ E_ab node by node, nine times fewer entries than the six matrices W_ab.
struct NodalMass {
  /// Scalar mass matrix, N×N over all nodes [kg], which several may read; null: none.
  linalg::SharedMatrix Ms;
  std::vector<std::array<int, 3>> dofs;  ///< per node the DOF of its translations

  bool empty() const { return !Ms || Ms.nonZeros() == 0; }
  /// Whether node j has the variables 3j, 3j + 1 and 3j + 2.
  bool is_numbered_by_node() const;
};

/// Inertia integrals of a body over its undeformed shape s0 (from the mass centre, model axes) and
/// its shape vectors g: the displacement of a material point is g(d) = Σ g_k d_k, FM (1).
///
/// They derive from the same kinetic energy as M; for beams without rotary inertia the torsional
/// flywheels are in M and J0 only. Theory: docs/theory/07-beam.md.
struct ShapeIntegrals {
  double mass = 0;                                ///< [kg]
  Eigen::Vector3d com = Eigen::Vector3d::Zero();  ///< mass centre in model axes [m]
  Eigen::Matrix3d C0 = Eigen::Matrix3d::Zero();   ///< ∫ s0 s0ᵀ dm [kg m²]
  /// Rotary inertia about the mass centre: tr(C0) 1 − C0 plus what is in M only [kg m²], FM (40).
  Eigen::Matrix3d J0 = Eigen::Matrix3d::Zero();
  /// W_11, W_22, W_33, W_12, W_13, W_23 with W_ab = ∫ g_a g_bᵀ dm, n×n; W_ba = W_abᵀ.
  /// Without the part in `nodal`. Of solids alone they have no entries and no size.
  std::array<linalg::SparseMatrix, 6> W;
  NodalMass nodal;
  /// n×9, column 3a+b (from zero) is c_ab = ∫ s0_a g_b dm, FM (53). Empty of large solids once they
  /// are bodies: body::InertiaInvariants::first_moments().
  linalg::Matrix c;
};

}  // namespace buckens::fem
