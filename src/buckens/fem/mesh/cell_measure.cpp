// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/mesh/cell_measure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Geometry>

#include "buckens/fem/mesh/cell_faces.h"
#include "buckens/fem/shell/shape.h"
#include "buckens/fem/solid/element.h"

namespace buckens::fem {

using Eigen::Vector3d;

namespace {

using Points = std::vector<Vector3d>;

std::optional<SolidKind> solid_kind(CellKind kind) {
  switch (kind) {
    case CellKind::tet4:
      return SolidKind::tet4;
    case CellKind::tet10:
      return SolidKind::tet10;
    case CellKind::hex8:
      return SolidKind::hex8;
    case CellKind::hex20:
      return SolidKind::hex20;
    case CellKind::wedge6:
      return SolidKind::wedge6;
    case CellKind::wedge15:
      return SolidKind::wedge15;
    case CellKind::pyramid5:
      return SolidKind::pyramid5;
    default:
      return std::nullopt;
  }
}

NodeVectors columns(const Points& x) {
  NodeVectors out(3, static_cast<Eigen::Index>(x.size()));
  for (std::size_t k = 0; k < x.size(); ++k) out.col(static_cast<Eigen::Index>(k)) = x[k];
  return out;
}

CellMeasure simplex_measure(const Points& x, double size) {
  // ∫λ_a λ_b = size (1 + δ_ab)/((n)(n + 1)) with n corners.
  const auto n = static_cast<double>(x.size());
  CellMeasure out;
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& corner : x) sum += corner;
  out.size = size;
  out.first = size / n * sum;
  out.second = sum * sum.transpose();
  for (const Vector3d& corner : x) out.second += corner * corner.transpose();
  out.second *= size / (n * (n + 1.0));
  return out;
}

CellMeasure surface_measure(const Points& x) {
  CellMeasure out;
  for (std::size_t k = 1; k + 1 < x.size(); ++k) {
    const double area = 0.5 * (x[k] - x[0]).cross(x[k + 1] - x[0]).norm();
    out.add(simplex_measure({x[0], x[k], x[k + 1]}, area));
  }
  return out;
}

/// Of a surface with nodes on its sides, by the points that integrate its mass.
CellMeasure curved_measure(const Points& x) {
  const auto count = static_cast<Eigen::Index>(x.size());
  CellMeasure out;
  for (const ShellRulePoint& at : shell_mass_rule(count)) {
    const ShellShape shape = shell_shape(count, at.r, at.s);
    Vector3d place = Vector3d::Zero(), along_r = Vector3d::Zero(), along_s = Vector3d::Zero();
    for (Eigen::Index k = 0; k < count; ++k) {
      const Vector3d& node = x[static_cast<std::size_t>(k)];
      place += shape.N[k] * node;
      along_r += shape.slope(0, k) * node;
      along_s += shape.slope(1, k) * node;
    }
    const double area = at.weight * along_r.cross(along_s).norm();
    out.add({area, area * place, area * place * place.transpose()});
  }
  return out;
}

double determinant(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  return a.cross(b).dot(c);
}

}  // namespace

CellMeasure& CellMeasure::add(const CellMeasure& other, double factor) {
  size += factor * other.size;
  first += factor * other.first;
  second += factor * other.second;
  return *this;
}

CellMeasure cell_measure(CellKind kind, const Points& x) {
  const auto corners = static_cast<std::size_t>(num_corners(kind));
  if (kind == CellKind::point1) return {};
  if (dimension_of(kind) == 1) return simplex_measure({x[0], x[1]}, (x[1] - x[0]).norm());
  if (kind == CellKind::tri6 || kind == CellKind::quad8) return curved_measure(x);
  if (dimension_of(kind) == 2) {
    return surface_measure({x.begin(), x.begin() + static_cast<std::ptrdiff_t>(corners)});
  }
  const auto solid = solid_kind(kind);
  if (!solid) return {};
  const NodeVectors places = columns(x);
  const NodeProducts products = solid_volume_products(*solid, places);
  CellMeasure out;
  out.size = products.sum();
  out.first = places * products.rowwise().sum();
  out.second = places * products * places.transpose();
  return out;
}

double aspect_ratio(CellKind kind, const Points& x) {
  double shortest = std::numeric_limits<double>::infinity(), longest = 0;
  for (const auto& [a, b] : cell_edges(kind)) {
    const double length = (x[static_cast<std::size_t>(b)] - x[static_cast<std::size_t>(a)]).norm();
    shortest = std::min(shortest, length);
    longest = std::max(longest, length);
  }
  if (dimension_of(kind) < 2) return 1.0;
  if (longest == 0.0) return std::numeric_limits<double>::infinity();  // all nodes at one place
  const int corners = num_corners(kind);
  if (dimension_of(kind) == 2 && corners == 3) {
    const double area = 0.5 * (x[1] - x[0]).cross(x[2] - x[0]).norm();
    const double around = (x[1] - x[0]).norm() + (x[2] - x[1]).norm() + (x[0] - x[2]).norm();
    return longest * around / (4.0 * std::sqrt(3.0) * area);  // r = 2 A/around, best h = 2√3 r
  }
  if (corners == 4 && dimension_of(kind) == 3) {
    double area = 0;
    for (const CellFace& face : cell_faces(kind)) {
      const auto at = [&](std::size_t k) { return x[static_cast<std::size_t>(face[k])]; };
      area += 0.5 * (at(1) - at(0)).cross(at(2) - at(0)).norm();
    }
    const double volume = std::abs(determinant(x[1] - x[0], x[2] - x[0], x[3] - x[0])) / 6.0;
    return longest * area / (6.0 * std::sqrt(6.0) * volume);  // r = 3 V/area, best h = 2√6 r
  }
  return longest / shortest;
}

bool is_inverted(CellKind kind, const Points& x) {
  const auto solid = solid_kind(kind);
  return solid && !(solid_least_volume(*solid, columns(x)) > 0.0);
}

bool is_inverted_at_node(CellKind kind, const Points& x) {
  if (kind == CellKind::pyramid5) {
    for (std::size_t k = 0; k < 4; ++k) {
      const Vector3d &here = x[k], &next = x[(k + 1) % 4], &last = x[(k + 3) % 4];
      if (determinant(next - here, last - here, x[4] - here) <= 0.0) return true;
    }
    return false;
  }
  const auto solid = solid_kind(kind);
  return solid && !(solid_least_node_volume(*solid, columns(x)) > 0.0);
}

}  // namespace buckens::fem
