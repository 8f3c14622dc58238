// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include <Eigen/Core>

namespace buckens::fem {

/// Corner coordinates of a hex8 element, one column per node [m].
///
/// Order: the lower face ζ = −1 counter-clockwise seen from above, then the upper face ζ = +1 in
/// the same order (as Abaqus C3D8, VTK and Gmsh count).
using Hex8Corners = Eigen::Matrix<double, 3, 8>;

/// Interpolation of a hex8 element at one point.
struct Hex8Point {
  Eigen::Matrix<double, 8, 1> N;         ///< shape functions
  Eigen::Matrix<double, 3, 8> gradient;  ///< ∂N/∂x in model axes [1/m]
  double volume = 0;                     ///< det ∂x/∂ξ [m³]
};

/// Signs (ξ, η, ζ) of the eight corners.
const Eigen::Matrix<double, 3, 8>& hex8_signs();

/// Trilinear interpolation at natural coordinates in [−1, 1]³. Where the element is turned inside
/// out `volume` is not positive and the gradient has no meaning.
Hex8Point hex8_point(const Hex8Corners& corners, const Eigen::Vector3d& natural);

/// Smallest Jacobian determinant over corners and stiffness points [m³].
double hex8_least_volume(const Hex8Corners& corners);

/// Strain ε = B q at a point: rows xx, yy, zz, xy, yz, zx (shear as 2ε), nodal variables by node.
Eigen::Matrix<double, 6, 24> hex8_strain(const Hex8Point& point);

/// Stress per strain of the isotropic solid [Pa].
/// @param E Young's modulus [Pa]
/// @param nu Poisson's ratio in (−1, ½)
Eigen::Matrix<double, 6, 6> solid_elasticity(double E, double nu);

/// ∫ Bᵀ D B dV by 2×2×2 points: exact for parallelepipeds, no zero-energy modes beyond the rigid
/// ones [N/m].
Eigen::Matrix<double, 24, 24> hex8_stiffness(const Hex8Corners& corners,
                                             const Eigen::Matrix<double, 6, 6>& D);

/// ∫ N Nᵀ dV by 3×3×3 points, exact for every shape [m³].
Eigen::Matrix<double, 8, 8> hex8_volume_products(const Hex8Corners& corners);

}  // namespace buckens::fem
