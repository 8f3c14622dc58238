// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/shell/strain.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace buckens::fem {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Slope = ShellSlope;
using Tangents = Eigen::Matrix<double, 3, 2>;

void set_curvature(const ShellElement& element, const Matrix3d& axes, const Slope& slope,
                   ShellStrain& rows) {
  const ShellRowBuilder build{element};
  const Tangents bend = element.directors * slope.transpose();  // ∂D/∂x, ∂D/∂y
  for (int a = 0; a < 2; ++a) {
    auto row = rows.row(3 + a);
    row.setZero();
    build.add_director(row, axes.col(a), slope.row(a));
    build.add_surface(row, bend.col(a), slope.row(a));
  }
  auto twist = rows.row(5);
  twist.setZero();
  for (int a = 0; a < 2; ++a) {
    build.add_director(twist, axes.col(a), slope.row(1 - a));
    build.add_surface(twist, bend.col(a), slope.row(1 - a));
  }
}

ShellShearRows covariant_shear(const ShellElement& element, double r, double s) {
  const ShellRowBuilder build{element};
  const ShellShape shape = shell_shape(element.nodes.cols(), r, s);
  const Tangents tangents = element.middle() * shape.slope.transpose();
  const Vector3d director = element.directors * shape.N;
  ShellShearRows rows = ShellShearRows::Zero(2, element.num_variables());
  for (int a = 0; a < 2; ++a) {
    auto row = rows.row(a);
    build.add_director(row, tangents.col(a), shape.N);
    build.add_surface(row, director, shape.slope.row(a));
  }
  return rows;
}

double drilling_share(const ShellElement& element, const Vector3d& normal, double square) {
  const double apart = (element.directors.colwise() - normal).colwise().squaredNorm().maxCoeff();
  const double h = element.stiffness->thickness;
  return 1 / (1 + apart * square / (h * h));
}

namespace {

/// Geometry of a quadrilateral at one point.
struct QuadPoint {
  ShellShape shape;
  Matrix3d axes;
  Matrix2d inverse;  // ∂(r, s)/∂(x, y)
  double area;       // per natural coordinates
  Slope slope;       // ∂N/∂x, ∂N/∂y

  QuadPoint(const ShellElement& element, double r, double s) : shape(shell_shape(4, r, s)) {
    const Tangents tangents = element.middle() * shape.slope.transpose();
    axes = shell_axes(element, tangents);
    const Matrix2d jacobian = axes.leftCols<2>().transpose() * tangents;
    inverse = jacobian.inverse();
    area = jacobian.determinant();
    slope = inverse.transpose() * shape.slope;
  }
};

/// Tying points of MITC4: the middles of the sides.
struct QuadShear {
  ShellShearRows at_s[2], at_r[2];  // s = ∓1, r = ∓1

  explicit QuadShear(const ShellElement& element)
      : at_s{covariant_shear(element, 0, -1), covariant_shear(element, 0, 1)},
        at_r{covariant_shear(element, -1, 0), covariant_shear(element, 1, 0)} {}

  ShellShearRows at(double r, double s) const {
    ShellShearRows out(2, at_s[0].cols());
    out.row(0) = 0.5 * (1 - s) * at_s[0].row(0) + 0.5 * (1 + s) * at_s[1].row(0);
    out.row(1) = 0.5 * (1 - r) * at_r[0].row(1) + 0.5 * (1 + r) * at_r[1].row(1);
    return out;
  }
};

void set_membrane(const ShellElement& element, const QuadPoint& p, ShellStrain& rows) {
  const ShellRowBuilder build{element};
  rows.topRows<3>().setZero();
  build.add_surface(rows.row(0), p.axes.col(0), p.slope.row(0));
  build.add_surface(rows.row(1), p.axes.col(1), p.slope.row(1));
  build.add_surface(rows.row(2), p.axes.col(0), p.slope.row(1));
  build.add_surface(rows.row(2), p.axes.col(1), p.slope.row(0));
}

/// Strains of the displacements 1 − r², 1 − s² along x and y. Their gradients are taken with the
/// Jacobian of the centre, so that their mean vanishes (Taylor, Beresford, Wilson, 1976).
void set_inner(const QuadPoint& centre, const QuadPoint& p, double r, double s,
               ShellStrainPoint& out) {
  const double scale = centre.area / p.area;
  for (int k = 0; k < 2; ++k) {
    const double slope = -2.0 * (k == 0 ? r : s) * scale;
    const Eigen::Vector2d g = slope * centre.inverse.row(k).transpose();
    out.inner(0, 2 * k) = g.x();
    out.inner(2, 2 * k) = g.y();
    out.inner(1, 2 * k + 1) = g.y();
    out.inner(2, 2 * k + 1) = g.x();
    out.inner_drilling[2 * k] = 0.5 * g.y();
    out.inner_drilling[2 * k + 1] = -0.5 * g.x();
  }
}

/// Drilling of the nodes against the surface, Σ N_i m_i·(θ_i − ω), with ω the rotation of the
/// surface at the point and m_i halfway between its normal there and the director of node i. Where
/// a curved shell bends without stretching, its rotation changes along the surface only, so that
/// this vanishes to second order in the angle between normals; n·(θ_i − ω) does not, and locks.
/// With axes x, y, n the surface turns by ω_x = n·U,y, ω_y = −n·U,x, ω_n = ½ (y·U,x − x·U,y).
ShellRow drilling_row(const ShellElement& element, const QuadPoint& p) {
  const ShellRowBuilder build{element};
  const Vector3d n = p.axes.col(2);
  ShellRow row = ShellRow::Zero(element.num_variables());
  Vector3d mean = Vector3d::Zero();
  for (Eigen::Index i = 0; i < element.nodes.cols(); ++i) {
    const Vector3d between = 0.5 * (n + element.directors.col(i));
    row.segment<3>(6 * i + 3) += p.shape.N[i] * between.transpose();
    mean += p.shape.N[i] * between;
  }
  const Vector3d m = p.axes.transpose() * mean;
  build.add_surface(row, -m.x() * n, p.slope.row(1));
  build.add_surface(row, m.y() * n, p.slope.row(0));
  build.add_surface(row, -0.5 * m.z() * p.axes.col(1), p.slope.row(0));
  build.add_surface(row, 0.5 * m.z() * p.axes.col(0), p.slope.row(1));
  return row;
}

ShellStrainPoint quad_point(const ShellElement& element, const QuadPoint& centre,
                            const QuadShear& shear, const ShellRulePoint& at) {
  const QuadPoint p(element, at.r, at.s);
  ShellStrainPoint out;
  out.area = at.weight * p.area;
  out.outer.resize(8, element.num_variables());
  set_membrane(element, p, out.outer);
  set_curvature(element, p.axes, p.slope, out.outer);
  out.outer.bottomRows<2>() = p.inverse.transpose() * shear.at(at.r, at.s);
  set_inner(centre, p, at.r, at.s, out);
  out.drilling = drilling_row(element, p);
  return out;
}

}  // namespace

ShellStrainField quadrilateral_strain(const ShellElement& element, bool with_corners) {
  const QuadPoint centre(element, 0, 0);
  const QuadShear shear(element);
  ShellStrainField out;
  out.num_inner = 4;
  out.drilling_share = drilling_share(element, centre.axes.col(2), 4 * centre.area);
  for (const ShellRulePoint& at : shell_rule(false, 2)) {
    out.points.push_back(quad_point(element, centre, shear, at));
  }
  out.centre = quad_point(element, centre, shear, {0, 0, 0});
  out.centre_axes = centre.axes;
  if (!with_corners) return out;
  for (const auto& [r, s] : {std::array{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
    out.corners.push_back(quad_point(element, centre, shear, {r, s, 0}));
    out.corner_axes.push_back(QuadPoint(element, r, s).axes);
  }
  return out;
}

}  // namespace buckens::fem
