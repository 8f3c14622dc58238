// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/abaqus/full_section.h"

#include <cmath>
#include <numbers>

namespace buckens::mesh_io {

namespace {

/// With diameters a along y and b along z; shear factors by Cowper (1966) at ν = 0.
fem::GeneralSectionSpec ellipse(double a, double b) {
  constexpr double kPi = std::numbers::pi;
  constexpr int kPoints = 16;  // between two of them the ellipse is higher by 2 %
  const double aa = a * a, bb = b * b;
  fem::GeneralSectionSpec out;
  out.A = kPi * a * b / 4;
  out.Iy = kPi * a * b * bb / 64;
  out.Iz = kPi * a * aa * b / 64;
  out.J = kPi * std::pow(a * b, 3) / (16 * (aa + bb));
  out.shear_factor_y = 12 * (3 * aa + bb) / (40 * aa + 16 * bb);
  out.shear_factor_z = 12 * (3 * bb + aa) / (40 * bb + 16 * aa);
  for (int k = 0; k < kPoints; ++k) {
    const double angle = 2 * kPi * k / kPoints;
    out.stress_points.push_back({a / 2 * std::cos(angle), b / 2 * std::sin(angle)});
  }
  return out;
}

}  // namespace

fem::SectionSpec full_section(bool is_round, double a, double b) {
  fem::SectionSpec out;
  if (!is_round) {
    out.shape = fem::RectangleSpec{a, b};
  } else if (a == b) {
    out.shape = fem::CircleSpec{a};
  } else {
    out.shape = ellipse(a, b);
  }
  return out;
}

}  // namespace buckens::mesh_io
