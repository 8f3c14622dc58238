// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

namespace buckens::fem {

/// A closed polygon of points (y, z) [m], its inside on the left seen against x: outlines run from
/// y to z, holes the other way round. Round ones have enough corners to look smooth.
using SectionLoop = std::vector<Eigen::Vector2d>;

/// Cross-section of a beam or bar in its principal axes y, z through the centroid.
///
/// Second moments are named after the axis of bending: Iy = ∫ z² dA, Iz = ∫ y² dA. Shear factors κ
/// follow Cowper (1966) at ν = 0: 5/6 for a rectangle, 6/7 for a circle.
struct Section {
  double A = 0;                ///< area [m²]
  double Iy = 0;               ///< ∫ z² dA [m⁴]
  double Iz = 0;               ///< ∫ y² dA [m⁴]
  double J = 0;                ///< torsion constant [m⁴]
  double shear_y = 1;          ///< κ of a shear force along y
  double shear_z = 1;          ///< κ of a shear force along z
  double shear_peak_y = 1.5;   ///< largest shear stress over Q_y / A
  double shear_peak_z = 1.5;   ///< largest shear stress over Q_z / A
  double torsion_modulus = 0;  ///< |M_t| over the largest torsional shear stress [m³]
  double outer_radius = 0;     ///< of the circumscribed circle about the centroid [m]
  std::vector<Eigen::Vector2d> stress_points;  ///< (y, z) where |σ_x| is examined [m]
  /// For drawing: the outer outline, then those of holes.
  std::vector<SectionLoop> outline;

  /// ∫ (y² + z²) dA [m⁴], the inertia of torsional motion per density and length.
  double polar_moment() const { return Iy + Iz; }

  static Section circle(double diameter);
  /// @throws ModelError unless 0 < inner < outer diameter
  static Section tube(double outer_diameter, double inner_diameter);
  /// @param width along the local y axis, @param height along the local z axis
  static Section rectangle(double width, double height);
  /// Rectangular hollow section with outer measures and one wall thickness; torsion after Bredt.
  /// @throws ModelError unless 0 < 2 thickness < width, height
  static Section box(double width, double height, double thickness);
  /// Stress points, torsion modulus, radius and outline are those of a rectangle with the same
  /// Iy/A, Iz/A; overwrite them where they are known.
  static Section general(double A, double Iy, double Iz, double J, double shear_y = 1,
                         double shear_z = 1);
  /// A bar needs an area only; bending and torsion constants are those of a circle.
  static Section area(double A);
};

/// The convex polygon around points, running from y to z; fewer than three points if they are
/// collinear.
SectionLoop convex_hull(std::vector<Eigen::Vector2d> points);

}  // namespace buckens::fem
