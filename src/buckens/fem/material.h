// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace buckens::fem {

/// Linear elastic isotropic material with Rayleigh damping C = α M + β K.
struct Material {
  double E = 0;                  ///< Young's modulus [Pa]
  double nu = 0;                 ///< Poisson's ratio
  double G = 0;                  ///< shear modulus [Pa]
  double rho = 0;                ///< density [kg/m³], zero allowed
  double damping_mass = 0;       ///< α [1/s]
  double damping_stiffness = 0;  ///< β [s]

  /// G = E / (2 (1 + ν)).
  static Material isotropic(double E, double nu, double rho) {
    return {E, nu, E / (2.0 * (1.0 + nu)), rho, 0.0, 0.0};
  }
};

}  // namespace buckens::fem
