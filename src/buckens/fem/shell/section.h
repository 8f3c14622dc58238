// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "buckens/fem/element/material.h"

namespace buckens::fem {

/// One layer of a shell.
struct ShellLayer {
  Material material;
  double thickness = 0;  ///< [m]
  double angle = 0;  ///< of material direction 1 from the shell's x axis, about its normal [rad]
};

/// Common to all elements of one shell: layers from the negative to the positive side of the
/// normal. One layer makes a homogeneous shell.
struct ShellSection {
  std::vector<ShellLayer> layers;
  double offset = 0;  ///< of the middle surface from the nodes, along the normal [m]
  /// The x axis of the shell is this direction (model axes) projected onto it.
  std::optional<Eigen::Vector3d> direction;
  /// Without `direction`: x is along the first side of each element, not close to model x.
  bool along_first_side = false;

  static ShellSection homogeneous(const Material& material, double thickness, double offset = 0) {
    return {{{material, thickness, 0.0}}, offset, std::nullopt, false};
  }
  double thickness() const;
};

/// Plane-stress elasticity of a layer in the axes of the shell: σ_x, σ_y, τ_xy per ε_x, ε_y, γ_xy,
/// and τ_xz, τ_yz per γ_xz, γ_yz [Pa].
struct LayerElasticity {
  Eigen::Matrix3d in_plane;
  Eigen::Matrix2d transverse;
};
LayerElasticity layer_elasticity(const ShellLayer& layer);

/// Forces and moments per length of a shell from the strain ε and curvature κ of its middle
/// surface and its transverse shear γ: N = A ε + B κ, M = B ε + D κ, Q = H γ, in the shell's axes.
/// Moments per area ∫ρ zᵏ dz about the middle surface.
struct ShellStiffness {
  double thickness = 0;  ///< [m]
  Eigen::Matrix3d A;     ///< [N/m]
  Eigen::Matrix3d B;     ///< [N]
  Eigen::Matrix3d D;     ///< [N m]
  /// With the shear correction of each axis: the energy of the shear stresses that equilibrium
  /// requires in cylindrical bending (5/6 for one layer) [N/m].
  Eigen::Matrix2d H;
  std::array<double, 3> inertia = {0, 0, 0};  ///< [kg/m², kg/m, kg]

  /// In-plane shear stiffness [N/m].
  double shear() const { return A(2, 2); }
};
ShellStiffness shell_stiffness(const ShellSection& section);

/// @param where start of the message
/// @throws ModelError if there is no layer, a thickness is not positive, constants are impossible,
/// or damping differs between layers
void check_shell_section(const std::string& where, const ShellSection& section);

}  // namespace buckens::fem
