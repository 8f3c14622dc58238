// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include <Eigen/Core>

namespace buckens::fem {

/// Constants of a material with three planes of symmetry. ν_ab is the contraction along b under
/// tension along a; ν_ba = ν_ab E_b/E_a follows.
struct Orthotropy {
  Eigen::Vector3d E = Eigen::Vector3d::Zero();  ///< Young's moduli E1, E2, E3 [Pa]
  double nu12 = 0;
  double nu13 = 0;
  double nu23 = 0;
  double G12 = 0;  ///< [Pa]
  double G13 = 0;
  double G23 = 0;
  /// Columns: directions 1, 2, 3 of the material in model axes, orthonormal.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
};

/// Linear elastic material with Rayleigh damping C = α M + β K.
struct Material {
  double E = 0;                  ///< Young's modulus [Pa]
  double nu = 0;                 ///< Poisson's ratio
  double G = 0;                  ///< shear modulus [Pa]
  double rho = 0;                ///< density [kg/m³], zero allowed
  double damping_mass = 0;       ///< α [1/s]
  double damping_stiffness = 0;  ///< β [s]
  /// For solids and layers of shells, instead of E, ν and G.
  std::optional<Orthotropy> orthotropy = std::nullopt;
  bool damps_held_motion = false;  ///< what α acts on, see FeModel::damps_held_motion

  /// G = E / (2 (1 + ν)).
  static Material isotropic(double E, double nu, double rho) {
    return {E, nu, E / (2.0 * (1.0 + nu)), rho, 0.0, 0.0, std::nullopt};
  }
};

}  // namespace buckens::fem
