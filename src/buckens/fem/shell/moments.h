// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "buckens/fem/shell/element.h"

namespace buckens::fem {

/// Moments of the mass of a shell element over its displacement field: products of shape functions
/// times ∫ρ zᵏ dz, z from the nodes, and first moments of the material points per node.
struct ShellMoments {
  /// Square in the nodes.
  using Products =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostShellNodes, kMostShellNodes>;
  std::array<Products, 3> products;
  ShellVectors with_translation, with_rotation;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();   ///< ∫ s dm
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  ///< ∫ s sᵀ dm
  double mass = 0;

  /// @param origin from which positions s are measured [m]
  ShellMoments(const ShellElement& element, const Eigen::Vector3d& origin);

  /// W_ab without its part in translations only, which is products[0] ⊗ E_ab.
  /// @param pair number in the order of ShapeIntegrals::W
  ShellMatrix second_moment(const ShellVectors& directors, std::size_t pair) const;
};

}  // namespace buckens::fem
