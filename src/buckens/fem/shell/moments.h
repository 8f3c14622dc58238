// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "buckens/fem/shell/element.h"

namespace buckens::fem {

/// Moments of the mass of a shell element over its displacement field: products of shape functions
/// times ∫ρ zᵏ dz, z from the nodes, and first moments of the material points per node.
struct ShellMoments {
  std::array<Eigen::Matrix4d, 3> products = {Eigen::Matrix4d::Zero(), Eigen::Matrix4d::Zero(),
                                             Eigen::Matrix4d::Zero()};
  Eigen::Matrix<double, 3, 4> with_translation = Eigen::Matrix<double, 3, 4>::Zero();
  Eigen::Matrix<double, 3, 4> with_rotation = Eigen::Matrix<double, 3, 4>::Zero();
  Eigen::Vector3d first = Eigen::Vector3d::Zero();   ///< ∫ s dm
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  ///< ∫ s sᵀ dm
  double mass = 0;

  /// @param origin from which places s are measured [m]
  ShellMoments(const ShellElement& element, const Eigen::Vector3d& origin);

  /// W_ab without its part over translations alone, which is products[0] ⊗ E_ab.
  /// @param pair number in the order of ShapeIntegrals::W
  ShellMatrix second_moment(const ShellVectors& directors, std::size_t pair) const;
};

}  // namespace buckens::fem
