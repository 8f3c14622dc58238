// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/mesh/cylinder_mesh.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::fem {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

// Corner of the square core over the radius, and how far its sides bulge over their half length:
// angles between 105° and 135° where core and rings meet.
constexpr double kCore = 0.6;
constexpr double kBulge = 0.2;

/// Cells of a cross-section, nine points each at i + 3 j; outer and inner cells touch the circles
/// by their sides i = 2 and i = 0.
struct CrossSection {
  std::vector<Vector2d> points;
  std::vector<std::array<int, 9>> cells;
  std::vector<int> outer, inner;  // cells
  int centre = -1;                // point
};

/// Rings between a closed line of points, counter-clockwise, and the circles further out.
/// @param inside points of the closed line, two per cell
void add_rings(const Cylinder& cylinder, const std::vector<int>& inside, double first_angle,
               CrossSection& section) {
  const auto count = static_cast<int>(inside.size());
  const int layers = 2 * cylinder.divisions[0];
  std::vector<std::vector<int>> circles = {inside};
  for (int k = 1; k <= layers; ++k) {
    auto& circle = circles.emplace_back();
    const double t = static_cast<double>(k) / layers;
    for (int j = 0; j < count; ++j) {
      const double angle = first_angle + 2.0 * M_PI * j / count;
      const Vector2d end = cylinder.outer_radius * Vector2d(std::cos(angle), std::sin(angle));
      const Vector2d start =
          section.points[static_cast<std::size_t>(inside[static_cast<std::size_t>(j)])];
      circle.push_back(static_cast<int>(section.points.size()));
      section.points.emplace_back((1.0 - t) * start + t * end);
    }
  }
  for (int k = 0; k < layers; k += 2) {
    for (int j = 0; j < count; j += 2) {
      const int cell = static_cast<int>(section.cells.size());
      auto& points = section.cells.emplace_back();
      for (int p = 0; p < 9; ++p) {
        points[static_cast<std::size_t>(p)] =
            circles[static_cast<std::size_t>(k + p % 3)]
                   [static_cast<std::size_t>((j + p / 3) % count)];
      }
      if (k == 0) section.inner.push_back(cell);
      if (k + 2 == layers) section.outer.push_back(cell);
    }
  }
}

CrossSection with_bore(const Cylinder& cylinder) {
  CrossSection out;
  const int count = 2 * cylinder.divisions[1];
  std::vector<int> inside;
  for (int j = 0; j < count; ++j) {
    const double angle = 2.0 * M_PI * j / count;
    inside.push_back(j);
    out.points.emplace_back(cylinder.inner_radius * Vector2d(std::cos(angle), std::sin(angle)));
  }
  add_rings(cylinder, inside, 0.0, out);
  return out;
}

CrossSection without_bore(const Cylinder& cylinder) {
  CrossSection out;
  const int n = cylinder.divisions[1] / 4;
  const int width = 2 * n + 1;
  const double half = kCore * cylinder.outer_radius / std::sqrt(2.0);
  const auto number = [width](int i, int j) { return i + width * j; };
  for (int j = 0; j < width; ++j) {
    for (int i = 0; i < width; ++i) {
      const double u = static_cast<double>(i - n) / n, v = static_cast<double>(j - n) / n;
      out.points.emplace_back(half * u * (1.0 + kBulge * (1.0 - v * v)),
                              half * v * (1.0 + kBulge * (1.0 - u * u)));
    }
  }
  for (int j = 0; j < 2 * n; j += 2) {
    for (int i = 0; i < 2 * n; i += 2) {
      auto& points = out.cells.emplace_back();
      for (int p = 0; p < 9; ++p) {
        points[static_cast<std::size_t>(p)] = number(i + p % 3, j + p / 3);
      }
    }
  }
  std::vector<int> edge;  // counter-clockwise from the corner at −45°
  for (int k = 0; k < 2 * n; ++k) edge.push_back(number(2 * n, k));
  for (int k = 0; k < 2 * n; ++k) edge.push_back(number(2 * n - k, 2 * n));
  for (int k = 0; k < 2 * n; ++k) edge.push_back(number(0, 2 * n - k));
  for (int k = 0; k < 2 * n; ++k) edge.push_back(number(k, 0));
  out.centre = number(n, n);
  add_rings(cylinder, edge, -0.25 * M_PI, out);
  return out;
}

void check(const Cylinder& c) {
  if (!(c.inner_radius >= 0.0 && c.outer_radius > c.inner_radius)) {
    throw ModelError(
        fmt::format("round solid with outer radius {:g} m and inner radius {:g} m; give 0 <= inner "
                    "< outer",
                    c.outer_radius, c.inner_radius));
  }
  if (!((c.to - c.from).norm() > 0.0)) {
    throw ModelError("round solid without length; its two ends must differ");
  }
  const auto [radial, around, along] = c.divisions;
  if (radial < 1 || around < 4 || along < 1) {
    throw ModelError(
        fmt::format("round solid in {} × {} × {} elements (radial, around, along); give at least "
                    "1, 4 and 1",
                    radial, around, along));
  }
  if (c.inner_radius == 0.0 && around % 4 != 0) {
    throw ModelError(
        fmt::format("round solid in {} elements around; without a bore their number must be "
                    "divisible by 4, for example {}",
                    around, 4 * (around / 4 + 1)));
  }
}

/// Axes of the cross-section and, third, of the solid; the first is near the model axis that is
/// most across.
Matrix3d axes_of(const Cylinder& c) {
  Matrix3d out;
  out.col(2) = (c.to - c.from).normalized();
  Eigen::Index across = 0;
  out.col(2).cwiseAbs().minCoeff(&across);
  const Vector3d hint = Vector3d::Unit(across);
  out.col(0) = (hint - hint.dot(out.col(2)) * out.col(2)).normalized();
  out.col(1) = out.col(2).cross(out.col(0));
  return out;
}

}  // namespace

CellMesh cylinder_cells(const Cylinder& cylinder) {
  check(cylinder);
  const bool bore = cylinder.inner_radius > 0.0;
  const CrossSection section = bore ? with_bore(cylinder) : without_bore(cylinder);
  const Matrix3d axes = axes_of(cylinder);
  const int along = cylinder.divisions[2];
  const auto layer = static_cast<int>(section.points.size());
  CellMesh out;
  for (int k = 0; k <= 2 * along; ++k) {
    const Vector3d centre =
        cylinder.from + static_cast<double>(k) / (2 * along) * (cylinder.to - cylinder.from);
    for (const Vector2d& p : section.points) {
      out.points.emplace_back(centre + axes.leftCols<2>() * p);
    }
  }
  out.face_sets = {{"bottom", {}}, {"top", {}}, {bore ? "outer" : "side", {}}};
  if (bore) out.face_sets.push_back({"inner", {}});
  const auto per_layer = static_cast<int>(section.cells.size());
  for (int k = 0; k < along; ++k) {
    for (const auto& flat : section.cells) {
      auto& points = out.cells.emplace_back();
      for (std::size_t p = 0; p < 27; ++p) {
        points[p] = flat[p % 9] + layer * (2 * k + static_cast<int>(p / 9));
      }
    }
    for (const int cell : section.outer) {
      out.face_sets[2].faces.push_back({k * per_layer + cell, 1});
    }
    for (const int cell : section.inner) {
      if (bore) out.face_sets[3].faces.push_back({k * per_layer + cell, 0});
    }
  }
  for (int cell = 0; cell < per_layer; ++cell) {
    out.face_sets[0].faces.push_back({cell, 4});
    out.face_sets[1].faces.push_back({(along - 1) * per_layer + cell, 5});
  }
  if (!bore) {
    out.names.emplace_back("bottom_centre", section.centre);
    out.names.emplace_back("centre", section.centre + layer * along);
    out.names.emplace_back("top_centre", section.centre + layer * 2 * along);
  }
  return out;
}

}  // namespace buckens::fem
