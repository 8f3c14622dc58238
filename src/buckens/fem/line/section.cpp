// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/line/section.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::fem {

namespace {

constexpr double kPi = std::numbers::pi;

void require_positive(double value, const char* what) {
  if (value > 0.0 && std::isfinite(value)) return;
  throw ModelError(fmt::format("section: {} is {:g}; give a positive number", what, value));
}

/// Four corners: bending about both axes is largest there.
std::vector<Eigen::Vector2d> corners(double half_width, double half_height) {
  return {{half_width, half_height},
          {-half_width, half_height},
          {-half_width, -half_height},
          {half_width, -half_height}};
}

/// Sixteen points miss the maximum of a cosine by 2 % at most.
std::vector<Eigen::Vector2d> rim(double radius) {
  constexpr int kPoints = 16;
  std::vector<Eigen::Vector2d> points;
  for (int k = 0; k < kPoints; ++k) {
    const double angle = 2.0 * kPi * k / kPoints;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return points;
}

/// Runs from y to z. Corners of 15°, so that drawing can distinguish them from edges.
SectionLoop round_loop(double radius) {
  constexpr int kCorners = 24;
  SectionLoop loop;
  for (int k = 0; k < kCorners; ++k) {
    const double angle = 2.0 * kPi * k / kCorners;
    loop.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return loop;
}

/// The same line as the rim of a hole.
SectionLoop hole(SectionLoop loop) {
  std::reverse(loop.begin(), loop.end());
  return loop;
}

Section ring(double outer, double inner) {
  const double R = 0.5 * outer;
  const double r = 0.5 * inner;
  Section s;
  s.A = kPi * (R * R - r * r);
  s.Iy = s.Iz = 0.25 * kPi * (std::pow(R, 4) - std::pow(r, 4));
  s.J = 2.0 * s.Iy;
  const double m2 = (r / R) * (r / R);
  const double square = (1.0 + m2) * (1.0 + m2);
  s.shear_y = s.shear_z = 6.0 * square / (7.0 * square + 20.0 * m2);
  // V Q / (I t) at the diameter.
  s.shear_peak_y = s.shear_peak_z = 4.0 / 3.0 * (R * R + R * r + r * r) / (R * R + r * r);
  s.torsion_modulus = s.J / R;
  s.outer_radius = R;
  s.stress_points = rim(R);
  s.outline.push_back(round_loop(R));
  if (r > 0.0) s.outline.push_back(hole(round_loop(r)));
  return s;
}

/// Cowper (1966), thin-walled box at ν = 0, shear along `height`; middle-line measures, one
/// thickness.
double box_shear_factor(double width, double height) {
  const double m = width / height;
  const double n = width / height;
  return 10.0 * (1.0 + 3.0 * m) * (1.0 + 3.0 * m) /
         (12.0 + 72.0 * m + 150.0 * m * m + 90.0 * m * m * m + 30.0 * n * n * (m + m * m));
}

/// τ_max over V / A at the neutral axis of a box for shear along `height`.
double box_shear_peak(double width, double height, double thickness, double A, double I) {
  const double inner_width = width - 2.0 * thickness;
  const double inner_height = height - 2.0 * thickness;
  const double moment = (width * height * height - inner_width * inner_height * inner_height) / 8.0;
  return A * moment / (I * 2.0 * thickness);
}

}  // namespace

Section Section::circle(double diameter) {
  require_positive(diameter, "the diameter");
  return ring(diameter, 0.0);
}

Section Section::tube(double outer_diameter, double inner_diameter) {
  require_positive(outer_diameter, "the outer diameter");
  require_positive(inner_diameter, "the inner diameter");
  if (inner_diameter >= outer_diameter) {
    throw ModelError(
        fmt::format("section tube: the inner diameter {:g} m is not below the outer diameter "
                    "{:g} m; swap them or reduce the thickness",
                    inner_diameter, outer_diameter));
  }
  return ring(outer_diameter, inner_diameter);
}

Section Section::rectangle(double width, double height) {
  require_positive(width, "the width");
  require_positive(height, "the height");
  Section s;
  s.A = width * height;
  s.Iy = width * std::pow(height, 3) / 12.0;
  s.Iz = height * std::pow(width, 3) / 12.0;
  const double b = std::max(width, height);
  const double h = std::min(width, height);
  const double ratio = h / b;
  s.J = b * h * h * h * (1.0 / 3.0 - 0.21 * ratio * (1.0 - std::pow(ratio, 4) / 12.0));
  s.shear_y = s.shear_z = 5.0 / 6.0;
  // Roark's fit of the series, within 0.5 %.
  const double peak = 1.0 + ratio * (0.6095 + ratio * (0.8865 + ratio * (-1.8023 + ratio * 0.91)));
  s.torsion_modulus = b * h * h / (3.0 * peak);
  s.outer_radius = 0.5 * std::hypot(width, height);
  s.stress_points = corners(0.5 * width, 0.5 * height);
  s.outline = {s.stress_points};
  return s;
}

Section Section::box(double width, double height, double thickness) {
  require_positive(width, "the width");
  require_positive(height, "the height");
  require_positive(thickness, "the thickness");
  if (2.0 * thickness >= std::min(width, height)) {
    throw ModelError(
        fmt::format("section box: twice the thickness {:g} m is not below the outer measures "
                    "{:g} m × {:g} m; use a rectangle or thinner walls",
                    thickness, width, height));
  }
  const double bi = width - 2.0 * thickness;
  const double hi = height - 2.0 * thickness;
  Section s;
  s.A = width * height - bi * hi;
  s.Iy = (width * std::pow(height, 3) - bi * std::pow(hi, 3)) / 12.0;
  s.Iz = (height * std::pow(width, 3) - hi * std::pow(bi, 3)) / 12.0;
  const double bm = width - thickness;
  const double hm = height - thickness;
  s.J = 2.0 * thickness * bm * bm * hm * hm / (bm + hm);
  s.shear_y = box_shear_factor(hm, bm);
  s.shear_z = box_shear_factor(bm, hm);
  s.shear_peak_y = box_shear_peak(height, width, thickness, s.A, s.Iz);
  s.shear_peak_z = box_shear_peak(width, height, thickness, s.A, s.Iy);
  s.torsion_modulus = 2.0 * bm * hm * thickness;
  s.outer_radius = 0.5 * std::hypot(width, height);
  s.stress_points = corners(0.5 * width, 0.5 * height);
  s.outline = {s.stress_points, hole(corners(0.5 * bi, 0.5 * hi))};
  return s;
}

Section Section::general(double A, double Iy, double Iz, double J, double shear_y, double shear_z) {
  require_positive(A, "A");
  require_positive(Iy, "Iy");
  require_positive(Iz, "Iz");
  require_positive(J, "J");
  require_positive(shear_y, "the shear factor along y");
  require_positive(shear_z, "the shear factor along z");
  const double y = std::sqrt(3.0 * Iz / A);
  const double z = std::sqrt(3.0 * Iy / A);
  Section s;
  s.A = A;
  s.Iy = Iy;
  s.Iz = Iz;
  s.J = J;
  s.shear_y = shear_y;
  s.shear_z = shear_z;
  s.torsion_modulus = J / std::hypot(y, z);
  s.outer_radius = std::hypot(y, z);
  s.stress_points = corners(y, z);
  s.outline = {s.stress_points};
  return s;
}

Section Section::area(double A) {
  require_positive(A, "the area");
  return circle(2.0 * std::sqrt(A / kPi));
}

SectionLoop convex_hull(std::vector<Eigen::Vector2d> points) {
  const auto before = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y());
  };
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  // Andrew's monotone chain: the lower half from the left, the upper half back.
  SectionLoop hull;
  const auto add = [&hull](const Eigen::Vector2d& p, std::size_t kept) {
    while (hull.size() >= kept + 2) {
      const Eigen::Vector2d a = hull.back() - hull[hull.size() - 2], b = p - hull.back();
      // Rounding must not make a corner of three points on a line.
      if (a.x() * b.y() - a.y() * b.x() > 1e-12 * a.norm() * b.norm()) break;
      hull.pop_back();
    }
    hull.push_back(p);
  };
  for (const Eigen::Vector2d& p : points) add(p, 0);
  const std::size_t lower = hull.size() - 1;
  for (std::size_t k = points.size() - 1; k-- > 0;) add(points[k], lower);
  hull.pop_back();
  return hull;
}

}  // namespace buckens::fem
