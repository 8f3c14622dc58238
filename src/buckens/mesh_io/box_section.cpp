// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/box_section.h"

#include <cmath>
#include <utility>

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

UnequalBox unequal_box_section(double width, double height, const std::array<double, 4>& walls) {
  const auto& [right, top, left, bottom] = walls;
  const double inner_w = width - right - left, inner_h = height - top - bottom;
  const double hole = inner_w * inner_h;
  const double hole_y = (left - right) / 2, hole_z = (bottom - top) / 2;
  UnequalBox out;
  fem::GeneralSectionSpec shape;
  shape.A = width * height - hole;
  const double y = -hole * hole_y / shape.A, z = -hole * hole_z / shape.A;
  out.centroid = {y, z};
  const double of_z = (width * std::pow(height, 3) - inner_w * std::pow(inner_h, 3)) / 12 -
                      hole * hole_z * hole_z - shape.A * z * z;  // ∫ z² dA about the centroid
  const double of_y = (height * std::pow(width, 3) - inner_h * std::pow(inner_w, 3)) / 12 -
                      hole * hole_y * hole_y - shape.A * y * y;
  const double of_yz = -hole * hole_y * hole_z - shape.A * y * z;
  out.angle = 0.5 * std::atan2(2 * of_yz, of_y - of_z);
  const double radius = std::hypot(0.5 * (of_y - of_z), of_yz);
  shape.Iz = 0.5 * (of_y + of_z) + radius;
  shape.Iy = 0.5 * (of_y + of_z) - radius;
  const double mid_w = width - (right + left) / 2, mid_h = height - (top + bottom) / 2;
  const double around = mid_w / top + mid_w / bottom + mid_h / right + mid_h / left;
  const auto cubed = [](double t) { return t * t * t; };
  shape.J = 4 * std::pow(mid_w * mid_h, 2) / around +
            (mid_w * (cubed(top) + cubed(bottom)) + mid_h * (cubed(right) + cubed(left))) / 3;
  const double cosine = std::cos(out.angle), sine = std::sin(out.angle);
  const double along_y = (top + bottom) * width / shape.A;
  const double along_z = (right + left) * height / shape.A;
  shape.shear_factor_y = along_y * cosine * cosine + along_z * sine * sine;
  shape.shear_factor_z = along_y * sine * sine + along_z * cosine * cosine;
  for (const auto& [sy, sz] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}) {
    const double py = sy * width / 2 - y, pz = sz * height / 2 - z;
    shape.stress_points.push_back({cosine * py + sine * pz, cosine * pz - sine * py});
  }
  out.section.shape = std::move(shape);
  return out;
}

}  // namespace buckens::mesh_io
