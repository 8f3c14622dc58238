// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/line/beam_shape.h"

#include <Eigen/LU>

namespace buckens::fem {

namespace {

/// Polynomial in ξ, lowest power first.
using Cubic = std::array<double, 4>;

/// Bending in one plane: deflection v and section rotation θ for unit v_a, θ_a, v_b, θ_b, with
/// θ = v' − γ and constant γ. Przemieniecki, Theory of Matrix Structural Analysis, §5.6.
struct BendingShape {
  std::array<Cubic, 4> deflection;
  std::array<Cubic, 4> rotation;
};

BendingShape bending_shape(double L, double Phi) {
  const double m = 1.0 / (1.0 + Phi);
  const double half = 0.5 * Phi;
  BendingShape shape;
  shape.deflection = {{{1.0, -m * Phi, -3.0 * m, 2.0 * m},
                       {0.0, m * L * (1.0 + half), -m * L * (2.0 + half), m * L},
                       {0.0, m * Phi, 3.0 * m, -2.0 * m},
                       {0.0, -m * L * half, m * L * (half - 1.0), m * L}}};
  shape.rotation = {{{0.0, -6.0 * m / L, 6.0 * m / L, 0.0},
                     {1.0, -m * (4.0 + Phi), 3.0 * m, 0.0},
                     {0.0, 6.0 * m / L, -6.0 * m / L, 0.0},
                     {0.0, m * (Phi - 2.0), 3.0 * m, 0.0}}};
  return shape;
}

// Columns of v_a, θ_a, v_b, θ_b among the twelve, and the sign of the rotation: positive θ_z raises
// v, positive θ_y lowers w.
struct BendingPlane {
  int component;           // of displacement
  int rotation_component;  // of rotation
  double sign;
};

void place_bending(const BendingShape& bending, const BendingPlane& plane, BeamShape& shape) {
  for (int k = 0; k < 4; ++k) {
    const auto variable = static_cast<std::size_t>(k);
    const bool is_rotation = k % 2 == 1;
    const int column = 6 * (k / 2) + (is_rotation ? 3 + plane.rotation_component : plane.component);
    const double sign = is_rotation ? plane.sign : 1.0;
    for (std::size_t power = 0; power < 4; ++power) {
      shape.displacement.terms[power](plane.component, column) =
          sign * bending.deflection[variable][power];
      shape.rotation.terms[power](plane.rotation_component, column) =
          sign * plane.sign * bending.rotation[variable][power];
    }
  }
}

/// Linear interpolation of one component of the field: columns a and b.
void place_linear(ShapePolynomial<12>& field, int component, int column) {
  field.terms[0](component, column) = 1.0;
  field.terms[1](component, column) = -1.0;
  field.terms[1](component, column + 6) = 1.0;
}

/// The 4×4 bending stiffness of v_a, θ_a, v_b, θ_b.
Eigen::Matrix4d uniform_bending(double EI, double L, double Phi) {
  Eigen::Matrix4d k;
  k << 12.0, 6.0 * L, -12.0, 6.0 * L,                               //
      6.0 * L, (4.0 + Phi) * L * L, -6.0 * L, (2.0 - Phi) * L * L,  //
      -12.0, -6.0 * L, 12.0, -6.0 * L,                              //
      6.0 * L, (2.0 - Phi) * L * L, -6.0 * L, (4.0 + Phi) * L * L;
  return EI / (L * L * L * (1.0 + Phi)) * k;
}

/// The same from the flexibility of the free end of a cantilever.
/// @param per_EI ∫ (1 − ξ)ᵏ dξ/(E I), k = 0, 1, 2
/// @param per_GA ∫ dξ/(κ G A), zero without shear
Eigen::Matrix4d tapered_bending(const std::array<double, 3>& per_EI, double per_GA, double L) {
  Eigen::Matrix2d flexibility;
  flexibility << L * L * L * per_EI[2] + L * per_GA, L * L * per_EI[1],  //
      L * L * per_EI[1], L * per_EI[0];
  Eigen::Matrix<double, 2, 4> relative;  // motion of the second end as seen from the first
  relative << -1.0, -L, 1.0, 0.0,        //
      0.0, -1.0, 0.0, 1.0;
  return relative.transpose() * flexibility.inverse() * relative;
}

using BeamMatrix = Eigen::Matrix<double, 12, 12>;

/// @param along_y, along_z bending of v, θ_z and of w, −θ_y
BeamMatrix beam_matrix(double axial, double torsion, const Eigen::Matrix4d& along_y,
                       const Eigen::Matrix4d& along_z) {
  BeamMatrix K = BeamMatrix::Zero();
  const auto add_two_node = [&K](int dof, double k) {
    K(dof, dof) = K(dof + 6, dof + 6) = k;
    K(dof, dof + 6) = K(dof + 6, dof) = -k;
  };
  add_two_node(0, axial);
  add_two_node(3, torsion);
  constexpr std::array<int, 4> kAlongY = {1, 5, 7, 11};
  constexpr std::array<int, 4> kAlongZ = {2, 4, 8, 10};
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      const auto row = static_cast<std::size_t>(i);
      const auto column = static_cast<std::size_t>(j);
      K(kAlongY[row], kAlongY[column]) = along_y(i, j);
      const double sign = (i + j) % 2 == 0 ? 1.0 : -1.0;  // θ_y = −w'
      K(kAlongZ[row], kAlongZ[column]) = sign * along_z(i, j);
    }
  }
  return K;
}

}  // namespace

ShearParameters shear_parameters(BeamTheory theory, const Material& material,
                                 const Section& section, double length) {
  if (theory == BeamTheory::euler_bernoulli) return {};
  const double scale = 12.0 * material.E / (material.G * section.A * length * length);
  return {scale * section.Iz / section.shear_y, scale * section.Iy / section.shear_z};
}

BeamShape beam_shape_local(double length, const ShearParameters& shear) {
  BeamShape shape;
  shape.displacement.degree = 3;
  shape.rotation.degree = 2;
  place_linear(shape.displacement, 0, 0);
  place_linear(shape.rotation, 0, 3);
  place_bending(bending_shape(length, shear.along_y), {1, 2, 1.0}, shape);
  place_bending(bending_shape(length, shear.along_z), {2, 1, -1.0}, shape);
  return shape;
}

BeamShape beam_shape(const LineFrame& frame, const ShearParameters& shear) {
  BeamShape shape = beam_shape_local(frame.length, shear);
  const Eigen::Matrix<double, 12, 12> to_local = beam_rotation(frame.axes).transpose();
  for (std::size_t power = 0; power < 4; ++power) {
    for (auto* field : {&shape.displacement, &shape.rotation}) {
      field->terms[power] = (frame.axes * field->terms[power] * to_local).eval();
    }
  }
  return shape;
}

BeamMatrix beam_stiffness_local(const Material& material, const Section& section, double length,
                                const ShearParameters& shear) {
  return beam_matrix(material.E * section.A / length, material.G * section.J / length,
                     uniform_bending(material.E * section.Iz, length, shear.along_y),
                     uniform_bending(material.E * section.Iy, length, shear.along_z));
}

BeamMatrix beam_stiffness_local(BeamTheory theory, const Material& material,
                                const SectionTaper& taper, double length) {
  const auto over_E = [&material](std::array<double, 3> flexibility) {
    for (double& f : flexibility) f /= material.E;
    return flexibility;
  };
  const double shear = theory == BeamTheory::timoshenko ? 1.0 / material.G : 0.0;
  return beam_matrix(material.E / (taper.per_A * length), material.G / (taper.per_J * length),
                     tapered_bending(over_E(taper.per_Iz), shear * taper.per_shear_y, length),
                     tapered_bending(over_E(taper.per_Iy), shear * taper.per_shear_z, length));
}

BeamMatrix beam_rotation(const Eigen::Matrix3d& axes) {
  BeamMatrix T = BeamMatrix::Zero();
  for (Eigen::Index k = 0; k < 4; ++k) T.block<3, 3>(3 * k, 3 * k) = axes;
  return T;
}

}  // namespace buckens::fem
