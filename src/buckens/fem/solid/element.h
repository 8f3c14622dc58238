// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "buckens/fem/element/elasticity.h"
#include "buckens/fem/solid/shape.h"

namespace buckens::fem {

/// Interpolation of an element at one point.
struct SolidPoint {
  NodeValues N;
  NodeVectors gradient;  ///< ∂N/∂x in model axes [1/m]
  double volume = 0;     ///< det ∂x/∂ξ [m³]
};

/// Strains as rows over the nodal variables, six rows as in Elasticity, node by node.
using StrainRows = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 3 * kMostSolidNodes>;
/// Square in the nodal variables of an element, node by node.
using SolidStiffness = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3 * kMostSolidNodes,
                                     3 * kMostSolidNodes>;
/// Square in the nodes of an element.
using NodeProducts =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostSolidNodes, kMostSolidNodes>;

/// Isoparametric interpolation at natural coordinates. Where the element is inverted, `volume` is
/// not positive and the gradient is meaningless.
/// @param x positions of the nodes [m]
SolidPoint solid_point(SolidKind kind, const NodeVectors& x, const Eigen::Vector3d& natural);

/// Smallest Jacobian determinant where an element is integrated [m³]: over the points of its
/// stiffness, and also over those of its mass if some of these make the mass indefinite. An element
/// with a positive one is usable, whatever its corners are like.
double solid_least_volume(SolidKind kind, const NodeVectors& x);
/// The same over its nodes; 0 at the apex of a pyramid.
double solid_least_node_volume(SolidKind kind, const NodeVectors& x);

/// Strain ε = B q at a point, from the gradients of the shape functions.
StrainRows solid_strain(const NodeVectors& gradient);

/// ∫ Bᵀ D B dV [N/m] by 2×2×2 (hex8), 3×3×3 (hex20), one (tet4), fourteen (tet10), 3×2
/// (wedge6), 6×3 (wedge15) or 2×2×2 points (pyramid5): exact for parallelepipeds, tetrahedra with
/// straight edges, straight prisms and pyramids over a parallelogram; no zero-energy modes beyond
/// rigid motion. A tet10 whose fourteen points do not all have a positive Jacobian uses four, if
/// these do.
///
/// Incompatible modes (hex8): inner displacements 1 − ξ_a² times three components, condensed out.
/// Their gradients use the Jacobian at the centre scaled by its determinant, so that the patch test
/// holds for every shape (Taylor, Beresford, Wilson, 1976).
SolidStiffness solid_stiffness(const SolidForm& form, const NodeVectors& x, const Elasticity& D);

/// ∫ N Nᵀ dV [m³], exact for every shape.
NodeProducts solid_volume_products(SolidKind kind, const NodeVectors& x);

}  // namespace buckens::fem
