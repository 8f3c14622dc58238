// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/shell/section.h"

#include <cmath>

#include <Eigen/LU>
#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/fem/element/elasticity.h"
#include "buckens/fem/element/quadrature.h"

namespace buckens::fem {

using Eigen::Matrix2d;
using Eigen::Matrix3d;

namespace {

/// Strains in axes turned by the angle, from strains in the shell's axes.
Matrix3d turned_strain(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  Matrix3d T;
  T << c * c, s * s, c * s, s * s, c * c, -c * s, -2 * c * s, 2 * c * s, c * c - s * s;
  return T;
}

/// Calls visit(layer, z of its bottom, z of its top), z from the middle surface.
template <class Visitor>
void visit_layers(const ShellSection& section, Visitor&& visit) {
  double z = -0.5 * section.thickness();
  for (const ShellLayer& layer : section.layers) {
    visit(layer, z, z + layer.thickness);
    z += layer.thickness;
  }
}

/// Share of ∫G dz that carries a shear force along one axis: R²/(∫G dz ∫ g²/G dz) with
/// g(z) = ∫ E (z − z_n) dz from the bottom, z_n the neutral axis and R = ∫ E (z − z_n)² dz.
double shear_correction(const ShellSection& section, Eigen::Index axis) {
  double E0 = 0, E1 = 0, E2 = 0, G0 = 0;
  visit_layers(section, [&](const ShellLayer& layer, double a, double b) {
    const LayerElasticity Q = layer_elasticity(layer);
    E0 += Q.in_plane(axis, axis) * (b - a);
    E1 += Q.in_plane(axis, axis) * (b * b - a * a) / 2;
    E2 += Q.in_plane(axis, axis) * (b * b * b - a * a * a) / 3;
    G0 += Q.transverse(axis, axis) * (b - a);
  });
  const double neutral = E1 / E0;
  const double R = E2 - E1 * neutral;
  const LineRule line = gauss_jacobi(3, 0);  // exact for g², of degree 4 in every layer
  double below = 0, compliance = 0;          // g at the bottom of the layer, ∫ g²/G dz
  visit_layers(section, [&](const ShellLayer& layer, double a, double b) {
    const LayerElasticity Q = layer_elasticity(layer);
    const auto g = [&](double z) {
      return below + Q.in_plane(axis, axis) * ((z * z - a * a) / 2 - neutral * (z - a));
    };
    for (Eigen::Index k = 0; k < line.place.size(); ++k) {
      const double z = 0.5 * (a + b) + 0.5 * (b - a) * line.place[k];
      compliance += 0.5 * (b - a) * line.weight[k] * g(z) * g(z) / Q.transverse(axis, axis);
    }
    below = g(b);
  });
  return R * R / (G0 * compliance);
}

}  // namespace

double ShellSection::thickness() const {
  double sum = 0;
  for (const ShellLayer& layer : layers) sum += layer.thickness;
  return sum;
}

LayerElasticity layer_elasticity(const ShellLayer& layer) {
  const Material& m = layer.material;
  LayerElasticity out;
  out.in_plane.setZero();
  if (!m.orthotropy) {
    const double E = m.E / (1 - m.nu * m.nu);
    out.in_plane << E, m.nu * E, 0, m.nu * E, E, 0, 0, 0, m.G;
    out.transverse = m.G * Matrix2d::Identity();
    return out;
  }
  const Orthotropy& o = *m.orthotropy;
  const double nu21 = o.nu12 * o.E[1] / o.E[0];
  const double scale = 1 / (1 - o.nu12 * nu21);
  Matrix3d Q;
  Q << scale * o.E[0], scale * nu21 * o.E[0], 0, scale * nu21 * o.E[0], scale * o.E[1], 0, 0, 0,
      o.G12;
  const Matrix3d T = turned_strain(layer.angle);
  out.in_plane = T.transpose() * Q * T;
  const double c = std::cos(layer.angle), s = std::sin(layer.angle);
  Matrix2d turn;
  turn << c, s, -s, c;
  out.transverse = turn.transpose() * Eigen::Vector2d(o.G13, o.G23).asDiagonal() * turn;
  return out;
}

ShellStiffness shell_stiffness(const ShellSection& section) {
  ShellStiffness out;
  out.thickness = section.thickness();
  out.A = out.B = out.D = Matrix3d::Zero();
  out.H = Matrix2d::Zero();
  visit_layers(section, [&](const ShellLayer& layer, double a, double b) {
    const LayerElasticity Q = layer_elasticity(layer);
    const double first = (b * b - a * a) / 2, second = (b * b * b - a * a * a) / 3;
    out.A += (b - a) * Q.in_plane;
    out.B += first * Q.in_plane;
    out.D += second * Q.in_plane;
    out.H += (b - a) * Q.transverse;
    const double rho = layer.material.rho;
    out.inertia[0] += rho * (b - a);
    out.inertia[1] += rho * first;
    out.inertia[2] += rho * second;
  });
  // Coupling of layers that lie symmetrically cancels but for rounding.
  const double size = out.thickness * out.A.cwiseAbs().maxCoeff();
  if (out.B.cwiseAbs().maxCoeff() <= 1e-14 * size) out.B.setZero();
  const Eigen::Vector2d root(std::sqrt(shear_correction(section, 0)),
                             std::sqrt(shear_correction(section, 1)));
  out.H = (root.asDiagonal() * out.H * root.asDiagonal()).eval();
  return out;
}

void check_shell_section(const std::string& where, const ShellSection& section) {
  if (section.layers.empty()) throw ModelError(where + ": the shell has no layer");
  const Material& first = section.layers.front().material;
  for (const ShellLayer& layer : section.layers) {
    if (!(layer.thickness > 0.0) || !std::isfinite(layer.thickness)) {
      throw ModelError(
          fmt::format("{}: thickness = {:g} m; it must be positive", where, layer.thickness));
    }
    check_solid_material(where, layer.material);
    if (layer.material.damping_mass == first.damping_mass &&
        layer.material.damping_stiffness == first.damping_stiffness &&
        layer.material.damps_held_motion == first.damps_held_motion) {
      continue;
    }
    throw ModelError(where +
                     ": its layers have different damping; give them the same, or the body one of "
                     "its own (`damping`)");
  }
}

}  // namespace buckens::fem
