// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/box_section.h"

#include <cmath>

namespace buckens::mesh_io {

fem::SectionSpec box_section(const BoxWalls& box) {
  fem::SectionSpec out;
  const double w = box.width, h = box.height, s = box.side, f = box.flat;
  // Rounding of numbers that a deck writes in two ways.
  if (std::abs(s - f) <= 1e-9 * s) {
    out.shape = fem::BoxSpec{w, h, s};
    return out;
  }
  const double inner_w = w - 2 * s, inner_h = h - 2 * f;
  fem::GeneralSectionSpec shape;
  shape.A = w * h - inner_w * inner_h;
  shape.Iy = (w * std::pow(h, 3) - inner_w * std::pow(inner_h, 3)) / 12;
  shape.Iz = (h * std::pow(w, 3) - inner_h * std::pow(inner_w, 3)) / 12;
  const double mid_w = w - s, mid_h = h - f;
  shape.J = 2 * std::pow(mid_w * mid_h, 2) / (mid_w / f + mid_h / s);
  shape.shear_factor_y = 2 * f * w / shape.A;
  shape.shear_factor_z = 2 * s * h / shape.A;
  shape.stress_points = {{w / 2, h / 2}, {-w / 2, h / 2}, {-w / 2, -h / 2}, {w / 2, -h / 2}};
  out.shape = shape;
  return out;
}

}  // namespace buckens::mesh_io
