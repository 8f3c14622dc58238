// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/solid/element.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "buckens/fem/element/quadrature.h"
#include "buckens/fem/solid/gradient_stiffness.h"

namespace buckens::fem {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

/// A rule with the shape functions at its points, made once per kind.
struct ShapeRule {
  struct Point {
    SolidShape shape;
    Vector3d natural;
    double weight;
  };
  std::vector<Point> points;

  ShapeRule(SolidKind kind, const QuadratureRule& rule) {
    for (const QuadraturePoint& p : rule) {
      points.push_back({solid_shape(kind, p.natural), p.natural, p.weight});
    }
  }
};

using RuleTable = std::array<ShapeRule, 7>;  // in the order of SolidKind

const ShapeRule& stiffness_rule(SolidKind kind) {
  static const RuleTable all = {ShapeRule(SolidKind::hex8, cube_rule(2)),
                                ShapeRule(SolidKind::hex20, cube_rule(3)),
                                ShapeRule(SolidKind::tet4, conical_rule(1)),
                                ShapeRule(SolidKind::tet10, symmetric_tetrahedron_rule()),
                                ShapeRule(SolidKind::wedge6, symmetric_wedge_rule(3, 2)),
                                ShapeRule(SolidKind::wedge15, symmetric_wedge_rule(6, 3)),
                                ShapeRule(SolidKind::pyramid5, pyramid_rule(2))};
  return all[static_cast<std::size_t>(kind)];
}

/// N Nᵀ det ∂x/∂ξ has in each coordinate degree 2 + 2 (hex8), 4 + 5 (hex20); in total 2 + 0 (tet4),
/// 4 + 3 (tet10); in the triangle and in ζ 2 + 1, 2 + 2 (wedge6), 4 + 4, 4 + 5 (wedge15); in the
/// collapsed coordinates 2 + 2 (pyramid5).
const ShapeRule& mass_rule(SolidKind kind) {
  static const RuleTable all = {
      ShapeRule(SolidKind::hex8, cube_rule(3)),       ShapeRule(SolidKind::hex20, cube_rule(5)),
      ShapeRule(SolidKind::tet4, conical_rule(2)),    ShapeRule(SolidKind::tet10, conical_rule(4)),
      ShapeRule(SolidKind::wedge6, wedge_rule(3)),    ShapeRule(SolidKind::wedge15, wedge_rule(5)),
      ShapeRule(SolidKind::pyramid5, pyramid_rule(3))};
  return all[static_cast<std::size_t>(kind)];
}

const ShapeRule& node_rule(SolidKind kind) {
  const auto at_nodes = [](SolidKind own) {
    QuadratureRule rule;
    for (const auto& place : solid_topology(own).natural.colwise()) rule.push_back({place, 1.0});
    return ShapeRule(own, rule);
  };
  static const RuleTable all = {at_nodes(SolidKind::hex8),    at_nodes(SolidKind::hex20),
                                at_nodes(SolidKind::tet4),    at_nodes(SolidKind::tet10),
                                at_nodes(SolidKind::wedge6),  at_nodes(SolidKind::wedge15),
                                at_nodes(SolidKind::pyramid5)};
  return all[static_cast<std::size_t>(kind)];
}

Matrix3d jacobian(const NodeVectors& x, const SolidShape& shape) {
  Matrix3d J = x.col(0) * shape.slope.col(0).transpose();  // ∂x/∂ξ
  for (Eigen::Index node = 1; node < x.cols(); ++node) {
    J.noalias() += x.col(node) * shape.slope.col(node).transpose();
  }
  return J;
}

double least_volume(const ShapeRule& rule, const NodeVectors& x) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& point : rule.points) {
    least = std::min(least, jacobian(x, point.shape).determinant());
  }
  return least;
}

/// Strain rows of the 3 columns that belong to a gradient.
template <class Block>
void set_strain(const Vector3d& g, Block&& block) {
  block.template topRows<3>() = g.asDiagonal();
  block.row(3) << g.y(), g.x(), 0.0;
  block.row(4) << 0.0, g.z(), g.y();
  block.row(5) << g.z(), 0.0, g.x();
}

template <std::size_t count>
void set_gradients(const Matrix3d& inverse, const SolidShape& shape,
                   std::array<Vector3d, count>& gradients) {
  for (Eigen::Index node = 0; node < shape.slope.cols(); ++node) {
    gradients[static_cast<std::size_t>(node)] = inverse.transpose() * shape.slope.col(node);
  }
}

/// Fills a matrix from entry (row, column) on.
template <int functions, class Block>
void copy_block(const GradientStiffness<functions>& sum, std::size_t row, std::size_t column,
                Block& out) {
  for (Eigen::Index j = 0; j < out.cols(); ++j) {
    for (Eigen::Index i = 0; i < out.rows(); ++i) {
      out(i, j) = sum(row + static_cast<std::size_t>(i), column + static_cast<std::size_t>(j));
    }
  }
}

/// The rule of the stiffness of an element. Fourteen points of a tetrahedron are so
/// close to its corners that some may be inverted if an edge is bent by its node; four
/// points, which other programs use, then suffice: they also leave no motion without
/// energy.
const ShapeRule& stiffness_rule(SolidKind kind, const NodeVectors& x) {
  static const ShapeRule four = [] {
    const double b = (5.0 - std::sqrt(5.0)) / 20.0;
    QuadratureRule rule(4, {Vector3d::Constant(b), 1.0 / 24.0});
    for (int a = 0; a < 3; ++a) {
      rule[static_cast<std::size_t>(a) + 1].natural[a] = 1.0 - 3.0 * b;
    }
    return ShapeRule(SolidKind::tet10, rule);
  }();
  const ShapeRule& usual = stiffness_rule(kind);
  if (kind != SolidKind::tet10 || least_volume(usual, x) > 0.0) return usual;
  return least_volume(four, x) > 0.0 ? four : usual;
}

/// Fixed sizes let the compiler unroll: assembly is most of what a large mesh costs before its
/// factor.
template <int nodes>
SolidStiffness full_stiffness(SolidKind kind, const NodeVectors& x, const Elasticity& D) {
  GradientStiffness<nodes> sum;
  std::array<Vector3d, nodes> gradients;
  for (const auto& point : stiffness_rule(kind, x).points) {
    const Matrix3d J = jacobian(x, point.shape);
    set_gradients(J.inverse(), point.shape, gradients);
    sum.add(gradients, point.weight * J.determinant(), D);
  }
  SolidStiffness K(3 * nodes, 3 * nodes);
  copy_block(sum, 0, 0, K);
  return K;
}

/// The three inner functions count behind the nodes, until they are condensed out.
SolidStiffness incompatible_stiffness(const NodeVectors& x, const Elasticity& D) {
  constexpr int kNodes = 8, kInner = 3;
  const Matrix3d centre = jacobian(x, solid_shape(SolidKind::hex8, Vector3d::Zero()));
  const Matrix3d centre_inverse = centre.inverse();
  const double centre_volume = centre.determinant();
  GradientStiffness<kNodes + kInner> sum;
  std::array<Vector3d, kNodes + kInner> gradients;
  for (const auto& point : stiffness_rule(SolidKind::hex8).points) {
    const Matrix3d J = jacobian(x, point.shape);
    const double volume = J.determinant();
    set_gradients(J.inverse(), point.shape, gradients);
    for (int a = 0; a < kInner; ++a) {
      const double slope = -2.0 * point.natural[a] * centre_volume / volume;
      gradients[static_cast<std::size_t>(kNodes + a)] = slope * centre_inverse.row(a).transpose();
    }
    sum.add(gradients, point.weight * volume, D);
  }
  SolidStiffness K(3 * kNodes, 3 * kNodes);
  Eigen::Matrix<double, 3 * kInner, 3 * kNodes> mixed;
  Eigen::Matrix<double, 3 * kInner, 3 * kInner> inner;
  copy_block(sum, 0, 0, K);
  copy_block(sum, 3 * kNodes, 0, mixed);
  copy_block(sum, 3 * kNodes, 3 * kNodes, inner);
  const Eigen::Matrix<double, 3 * kInner, 3 * kNodes> half = inner.llt().matrixL().solve(mixed);
  K.noalias() -= half.transpose() * half;
  return 0.5 * (K + K.transpose());
}

}  // namespace

SolidPoint solid_point(SolidKind kind, const NodeVectors& x, const Vector3d& natural) {
  const SolidShape shape = solid_shape(kind, natural);
  const Matrix3d J = jacobian(x, shape);
  return {shape.N, J.inverse().transpose() * shape.slope, J.determinant()};
}

double solid_least_volume(SolidKind kind, const NodeVectors& x) {
  const double in_stiffness = least_volume(stiffness_rule(kind, x), x);
  if (!(in_stiffness > 0.0)) return in_stiffness;
  const double in_mass = least_volume(mass_rule(kind), x);
  // Points near a corner may be outside as long as every motion keeps a positive mass.
  const bool has_mass =
      in_mass > 0.0 || solid_volume_products(kind, x).llt().info() == Eigen::Success;
  return has_mass ? in_stiffness : in_mass;
}

double solid_least_node_volume(SolidKind kind, const NodeVectors& x) {
  return least_volume(node_rule(kind), x);
}

StrainRows solid_strain(const NodeVectors& gradient) {
  StrainRows B(6, 3 * gradient.cols());
  for (Eigen::Index node = 0; node < gradient.cols(); ++node) {
    const Vector3d g = gradient.col(node);
    set_strain(g, B.middleCols<3>(3 * node));
  }
  return B;
}

SolidStiffness solid_stiffness(const SolidForm& form, const NodeVectors& x, const Elasticity& D) {
  switch (form.kind) {
    case SolidKind::hex8:
      return form.integration == SolidIntegration::incompatible_modes
                 ? incompatible_stiffness(x, D)
                 : full_stiffness<8>(form.kind, x, D);
    case SolidKind::hex20:
      return full_stiffness<20>(form.kind, x, D);
    case SolidKind::tet4:
      return full_stiffness<4>(form.kind, x, D);
    case SolidKind::tet10:
      return full_stiffness<10>(form.kind, x, D);
    case SolidKind::wedge6:
      return full_stiffness<6>(form.kind, x, D);
    case SolidKind::wedge15:
      return full_stiffness<15>(form.kind, x, D);
    case SolidKind::pyramid5:
      break;
  }
  return full_stiffness<5>(form.kind, x, D);
}

NodeProducts solid_volume_products(SolidKind kind, const NodeVectors& x) {
  NodeProducts products = NodeProducts::Zero(x.cols(), x.cols());
  for (const auto& point : mass_rule(kind).points) {
    const double weight = point.weight * jacobian(x, point.shape).determinant();
    products.noalias() += (weight * point.shape.N).lazyProduct(point.shape.N.transpose());
  }
  return 0.5 * (products + products.transpose());
}

}  // namespace buckens::fem
