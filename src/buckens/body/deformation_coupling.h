// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/base/task_pool.h"
#include "buckens/body/inertia_invariants.h"
#include "buckens/fem/element/shape_integrals.h"
#include "buckens/linalg/common_table.h"

namespace buckens::body {

/// Weights A and B of the nodal loads Σ (A_ab W_ab d + B_ab W_ab ḋ) of the deformation.
struct DeformationWeights {
  Eigen::Matrix3d with_d = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d with_rate = Eigen::Matrix3d::Zero();

  /// Those of FM (22)–(24) without ĉ. @param kept which of the three terms
  static DeformationWeights of_motion(const Eigen::Vector3d& w, const Eigen::Vector3d& w_dot,
                                      const CouplingTerms& kept);
  /// A and B for NodeKernels::couple.
  Eigen::Matrix<double, 4, 6> by_columns() const;
  bool are_zero() const { return with_d.isZero(0.0) && with_rate.isZero(0.0); }
};

/// The moments quadratic in d and the nodal loads of a deformation, in one pass over the inertia
/// integrals. Allocates nothing.
/// @param load n, added to, or overwritten; unchanged where the weights are zero
/// @param pool processes nodes of solids in parallel, with the same result
/// @param common holds a copy of the scalar mass matrix to be read; null: that of `shape`
/// @param overwrites whatever stood in the load: of solids without reading it from memory
DeformedMoments evaluate_deformation(const fem::ShapeIntegrals& shape, const linalg::Vector& d,
                                     const linalg::Vector& d_dot, const linalg::Vector& d_ddot,
                                     const DeformationWeights& weights, linalg::Vector& load,
                                     TaskPool* pool = nullptr,
                                     const linalg::CommonTable* common = nullptr,
                                     bool overwrites = false);

/// The moments quadratic in d from the sums of NodeKernels::couple over all nodes.
DeformedMoments deformed_moments(const linalg::NodeSums& sums);

}  // namespace buckens::body
