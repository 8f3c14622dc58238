// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace buckens::spatial {

/// A = V diag(λ) Vᵀ of a symmetric matrix of three rows, such as an inertia or a stress: Eigen's
/// SelfAdjointEigenSolver.
///
/// Compiled once: its templates take more than a second in each piece of sources that makes them.
struct PrincipalAxes {
  Eigen::Vector3d values;   ///< λ, ascending
  Eigen::Matrix3d vectors;  ///< orthonormal columns
};

/// @param A its lower triangle is read
PrincipalAxes principal_axes(const Eigen::Matrix3d& A);
/// Ascending, without vectors.
Eigen::Vector3d principal_values(const Eigen::Matrix3d& A);

}  // namespace buckens::spatial
