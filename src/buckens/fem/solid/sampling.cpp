// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/solid/sampling.h"

#include <cmath>

#include "buckens/fem/element/quadrature.h"
#include "buckens/linalg/small_lu.h"

namespace buckens::fem {

using Eigen::Vector3d;

namespace {

enum class Family { hexahedron, wedge, quadratic_tetrahedron, constant };

Family family_of(const SolidTopology& element) {
  if (element.num_corners == 8) return Family::hexahedron;
  if (element.num_corners == 6) return Family::wedge;
  if (element.num_corners == 4 && element.num_nodes == 10) return Family::quadratic_tetrahedron;
  return Family::constant;
}

std::vector<Vector3d> points_of(Family family, const Vector3d& centre) {
  std::vector<Vector3d> out;
  switch (family) {
    case Family::hexahedron:
      for (const QuadraturePoint& point : cube_rule(2)) out.push_back(point.natural);
      break;
    case Family::wedge:
      for (const double z : {-std::sqrt(1.0 / 3.0), std::sqrt(1.0 / 3.0)}) {
        out.emplace_back(1.0 / 6.0, 1.0 / 6.0, z);
        out.emplace_back(2.0 / 3.0, 1.0 / 6.0, z);
        out.emplace_back(1.0 / 6.0, 2.0 / 3.0, z);
      }
      break;
    case Family::quadratic_tetrahedron: {
      const double b = (5.0 - std::sqrt(5.0)) / 20.0;
      out.push_back(Vector3d::Constant(b));
      for (int a = 0; a < 3; ++a) {
        out.push_back(Vector3d::Constant(b));
        out.back()[a] = 1.0 - 3.0 * b;
      }
      break;
    }
    case Family::constant:
      out.push_back(centre);
      break;
  }
  return out;
}

/// As many polynomials as points.
Eigen::VectorXd polynomials(Family family, const Vector3d& p) {
  switch (family) {
    case Family::hexahedron:
      return Eigen::Vector<double, 8>(1.0, p.x(), p.y(), p.z(), p.x() * p.y(), p.y() * p.z(),
                                      p.z() * p.x(), p.x() * p.y() * p.z());
    case Family::wedge:
      return Eigen::Vector<double, 6>(1.0, p.x(), p.y(), p.z(), p.x() * p.z(), p.y() * p.z());
    case Family::quadratic_tetrahedron:
      return Eigen::Vector4d(1.0, p.x(), p.y(), p.z());
    case Family::constant:
      break;
  }
  return Eigen::VectorXd::Ones(1);
}

SolidSampling make_sampling(SolidKind kind) {
  const SolidTopology& element = solid_topology(kind);
  const Family family = family_of(element);
  SolidSampling out;
  for (const Vector3d& point : points_of(family, element.centre)) {
    out.points.push_back({point, solid_shape(kind, point)});
  }
  out.centre = solid_shape(kind, element.centre);
  const auto count = static_cast<Eigen::Index>(out.points.size());
  Eigen::MatrixXd at_points(count, count), at_nodes(element.num_nodes, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    at_points.row(k) = polynomials(family, out.points[static_cast<std::size_t>(k)].natural);
  }
  for (Eigen::Index n = 0; n < at_nodes.rows(); ++n) {
    at_nodes.row(n) = polynomials(family, element.natural.col(n));
  }
  out.to_nodes = at_nodes * linalg::general_inverse(at_points);
  return out;
}

}  // namespace

const SolidSampling& solid_sampling(SolidKind kind) {
  static const std::vector<SolidSampling> all = [] {
    std::vector<SolidSampling> out;
    for (std::size_t k = 0; k < choice_names(SolidKind{}).size(); ++k) {
      out.push_back(make_sampling(static_cast<SolidKind>(k)));
    }
    return out;
  }();
  return all[static_cast<std::size_t>(kind)];
}

}  // namespace buckens::fem
