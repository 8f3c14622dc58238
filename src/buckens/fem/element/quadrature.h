// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

namespace buckens::fem {

/// Point and weight of a rule over natural coordinates.
struct QuadraturePoint {
  Eigen::Vector3d natural;
  double weight;
};
using QuadratureRule = std::vector<QuadraturePoint>;

/// Points and weights of a rule on [−1, 1] that integrates polynomials up to degree 2n − 1 times
/// (1 − x)^power.
struct LineRule {
  Eigen::VectorXd place;
  Eigen::VectorXd weight;
};

/// Gauss–Jacobi points as eigenvalues of the three-term recurrence (Golub and Welsch, 1969);
/// power 0 are Gauss–Legendre points.
/// @param n number of points, positive
/// @param power exponent of (1 − x), not negative
LineRule gauss_jacobi(int n, int power);

/// n×n×n Gauss points of the cube [−1, 1]³: degree 2n − 1 in each coordinate.
QuadratureRule cube_rule(int n);

/// n×n×n points of the tetrahedron by collapsing a cube (Stroud's conical product): degree 2n − 1.
QuadratureRule conical_rule(int n);

/// n×n×n points of the wedge over the triangle ξ, η ≥ 0, ξ + η ≤ 1 with ζ in [−1, 1]: degree 2n − 1
/// in the triangle and in ζ.
QuadratureRule wedge_rule(int n);

/// Symmetric points of the triangle (3: degree 2, Hammer; 6: degree 4, Strang and Fix) times n
/// Gauss points along ζ.
QuadratureRule symmetric_wedge_rule(int triangle_points, int n);

/// n×n×n points of the pyramid with base [−1, 1]² at ζ = 0 and apex (0, 0, 1), by collapsing a
/// cube: degree 2n − 1 in ξ/(1 − ζ), η/(1 − ζ) and ζ.
QuadratureRule pyramid_rule(int n);

/// Fourteen symmetric points of the tetrahedron with positive weights, degree 5 (Walkington).
QuadratureRule symmetric_tetrahedron_rule();

}  // namespace buckens::fem
