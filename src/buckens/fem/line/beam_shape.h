// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/fem/element/material.h"
#include "buckens/fem/element/shape_polynomial.h"
#include "buckens/fem/line/frame.h"
#include "buckens/fem/line/section.h"
#include "buckens/fem/line/section_taper.h"

namespace buckens::fem {

enum class BeamTheory { euler_bernoulli, timoshenko };

/// Shear parameters Φ = 12 E I / (κ G A L²) of bending along y and along z; zero for
/// Euler–Bernoulli.
struct ShearParameters {
  double along_y = 0;
  double along_z = 0;
};

ShearParameters shear_parameters(BeamTheory theory, const Material& material,
                                 const Section& section, double length);

/// Interpolation of a beam between its ends, exact for static end loads.
///
/// Nodal variables q = [u_a θ_a u_b θ_b], three components each. Material points move by
/// g = u(ξ) + θ(ξ) × (0, y, z).
struct BeamShape {
  ShapePolynomial<12> displacement;  ///< u, cubic across and linear along the beam
  ShapePolynomial<12> rotation;      ///< θ, quadratic in bending and linear in torsion
};

/// Interpolation in element axes.
BeamShape beam_shape_local(double length, const ShearParameters& shear);

/// The same with nodal variables and values in model axes.
BeamShape beam_shape(const LineFrame& frame, const ShearParameters& shear);

/// Stiffness matrix in element axes, closed form [N/m, N, N m].
Eigen::Matrix<double, 12, 12> beam_stiffness_local(const Material& material, const Section& section,
                                                   double length, const ShearParameters& shear);

/// The same for a tapered element, from its flexibility: exact for any taper under loads at the
/// ends.
Eigen::Matrix<double, 12, 12> beam_stiffness_local(BeamTheory theory, const Material& material,
                                                   const SectionTaper& taper, double length);

/// Rotates the four triples of a beam's nodal variables: q_model = T q_element.
Eigen::Matrix<double, 12, 12> beam_rotation(const Eigen::Matrix3d& axes);

}  // namespace buckens::fem
