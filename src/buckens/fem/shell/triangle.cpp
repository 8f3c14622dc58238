// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "buckens/fem/shell/strain.h"

namespace buckens::fem {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Slope = ShellSlope;
using Tangents = Eigen::Matrix<double, 3, 2>;

namespace {

using PlaneRows = Eigen::Matrix<double, 3, 9>;  // over u_x, u_y, θ_z of each node

/// A triangle in its plane.
struct Plane {
  Matrix3d axes;
  Eigen::Matrix<double, 2, 3> place;
  double area;                       // [m²]
  Matrix2d inverse;                  // ∂(r, s)/∂(x, y)
  Slope slope;                       // ∂N/∂x, ∂N/∂y
  Eigen::Matrix<double, 9, 18> map;  // u_x, u_y, θ_z from the nodal variables

  explicit Plane(const ShellElement& element) {
    const ShellShape shape = shell_shape(3, 0, 0);
    const ShellVectors X = element.middle();
    const Tangents tangents = X * shape.slope.transpose();
    axes = shell_axes(element, tangents);
    place = axes.leftCols<2>().transpose() * (X.colwise() - X.col(0));
    const Matrix2d jacobian = axes.leftCols<2>().transpose() * tangents;
    inverse = jacobian.inverse();
    area = 0.5 * jacobian.determinant();
    slope = inverse.transpose() * shape.slope;
    map.setZero();
    const ShellRowBuilder build{element};
    for (Eigen::Index i = 0; i < 3; ++i) {
      const Vector3d only = Vector3d::Unit(i);
      build.add_surface(map.row(3 * i), axes.col(0), only);
      build.add_surface(map.row(3 * i + 1), axes.col(1), only);
      build.add_rotation(map.row(3 * i + 2), axes.col(2), only);
    }
  }
  double x(int i, int j) const { return place(0, i) - place(0, j); }
  double y(int i, int j) const { return place(1, i) - place(1, j); }
};

/// Constant strain with the share of the rotations that lumps the stress on the sides (Bergan,
/// Felippa, 1985).
PlaneRows basic_strain(const Plane& p) {
  constexpr double kAlpha = 1.5;
  PlaneRows out = PlaneRows::Zero();
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double y = p.y(j, k), x = p.x(k, j);
    out(0, 3 * i) = out(2, 3 * i + 1) = y;
    out(1, 3 * i + 1) = out(2, 3 * i) = x;
    out(0, 3 * i + 2) = kAlpha / 6 * y * (p.y(i, k) - p.y(j, i));
    out(1, 3 * i + 2) = kAlpha / 6 * x * (p.x(k, i) - p.x(i, j));
    out(2, 3 * i + 2) = kAlpha / 3 * (p.x(k, i) * p.y(i, k) - p.x(i, j) * p.y(j, i));
  }
  return out / (2 * p.area);
}

/// Rotations of the nodes against that of the plane.
PlaneRows rotation_against_plane(const Plane& p) {
  PlaneRows out = PlaneRows::Zero();
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    for (int row = 0; row < 3; ++row) {
      out(row, 3 * i) = p.x(k, j) / (4 * p.area);
      out(row, 3 * i + 1) = p.y(k, j) / (4 * p.area);
    }
    out(i, 3 * i + 2) = 1;
  }
  return out;
}

/// The same in space, n·(θ_i − ω) + ½ (n_i − n)·(θ_i − θ) with the mean θ of the nodes: taken about
/// m_i, halfway between the normal n and the director n_i. On a curved shell n·θ_i alone holds part
/// of its bending.
Eigen::Matrix<double, 3, 18> relative_rotation(const ShellElement& element, const Plane& p) {
  Eigen::Matrix<double, 3, 18> out = rotation_against_plane(p) * p.map;
  const ShellRowBuilder build{element};
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Vector3d beside = 0.5 * (element.directors.col(i) - p.axes.col(2));
    build.add_rotation(out.row(i), beside, Vector3d::Unit(i));
    build.add_rotation(out.row(i), beside, Vector3d::Constant(-1.0 / 3));
  }
  return out;
}

/// Strains along the three sides at the corners per relative rotations, with the optimal β.
std::array<Matrix3d, 3> side_strains(const Plane& p) {
  constexpr double b1 = 1, b2 = 2, b3 = 1, b4 = 0, b5 = 1, b6 = -1, b7 = -1, b8 = -1, b9 = -2;
  std::array<Matrix3d, 3> Q;
  Q[0] << b1, b2, b3, b4, b5, b6, b7, b8, b9;
  Q[1] << b9, b7, b8, b3, b1, b2, b6, b4, b5;
  Q[2] << b5, b6, b4, b8, b9, b7, b2, b3, b1;
  const auto square = [&p](int i, int j) {
    return std::pow(p.x(i, j), 2) + std::pow(p.y(i, j), 2);
  };
  const Vector3d sides(square(1, 0), square(2, 1), square(0, 2));
  for (Matrix3d& q : Q) q = (2 * p.area / 3 * sides.cwiseInverse().asDiagonal() * q).eval();
  return Q;
}

/// ε_x, ε_y, γ_xy from the strains along the sides 1–2, 2–3, 3–1.
Matrix3d from_sides(const Plane& p) {
  Matrix3d inverse;  // ε along a side: c², s², cs
  for (int side = 0; side < 3; ++side) {
    const double x = p.x((side + 1) % 3, side), y = p.y((side + 1) % 3, side);
    inverse.row(side) = Eigen::RowVector3d(x * x, y * y, x * y) / (x * x + y * y);
  }
  return inverse.inverse();
}

/// Membrane strains of the optimal triangle at area coordinates (Felippa, 2003): constant ones and
/// those of its three bending modes, whose energy β0 scales.
class OptimalMembrane {
 public:
  OptimalMembrane(const ShellElement& element, const Plane& plane)
      : basic_(basic_strain(plane) * plane.map) {
    const Matrix3d& A = element.stiffness->A;
    const double nu = A(0, 1) / std::sqrt(A(0, 0) * A(1, 1));
    const double beta = std::max(0.5 * (1 - 4 * nu * nu), 0.01) *
                        drilling_share(element, plane.axes.col(2), 2 * plane.area);
    const double scale = 1.5 * std::sqrt(beta);
    const Eigen::Matrix<double, 3, 18> turn = relative_rotation(element, plane);
    const Matrix3d T = from_sides(plane);
    const auto sides = side_strains(plane);
    for (std::size_t k = 0; k < 3; ++k) higher_[k] = scale * T * sides[k] * turn;
  }
  Eigen::Matrix<double, 3, 18> at(const Vector3d& N) const {
    return basic_ + N[0] * higher_[0] + N[1] * higher_[1] + N[2] * higher_[2];
  }

 private:
  Eigen::Matrix<double, 3, 18> basic_;
  std::array<Eigen::Matrix<double, 3, 18>, 3> higher_;
};

double bubble(double r, double s) { return 27 * r * s * (1 - r - s); }

/// Covariant shear with the two inner variables: the director at the centre moves along x and y.
struct BubbleShear {
  ShellShearRows outer;
  Matrix2d inner;

  BubbleShear(const ShellElement& element, const Plane& plane, double r, double s)
      : outer(covariant_shear(element, r, s)),
        inner(bubble(r, s) * plane.inverse.inverse().transpose()) {}
};

/// Assumed transverse shear of MITC3+: constant part and a rotation about the centre.
struct TriangleShear {
  using Row = Eigen::Matrix<double, 1, 20>;  // outer and inner variables
  Row r, s, turn;

  TriangleShear(const ShellElement& element, const Plane& plane) {
    const auto at = [&](double a, double b) {
      const BubbleShear shear(element, plane, a, b);
      Eigen::Matrix<double, 2, 20> out;
      out << shear.outer, shear.inner;
      return out;
    };
    constexpr double third = 1.0 / 3, sixth = 1.0 / 6, d = 1e-4;
    const auto A = at(sixth, 2 * third), B = at(2 * third, sixth), C = at(sixth, sixth);
    const auto D = at(third + d, third - 2 * d), E = at(third - 2 * d, third + d);
    const auto F = at(third + d, third + d);
    const Row common = third * (C.row(0) + C.row(1));
    r = 2 * third * (B.row(0) - 0.5 * B.row(1)) + common;
    s = 2 * third * (A.row(1) - 0.5 * A.row(0)) + common;
    turn = third * (F.row(0) - D.row(0) - F.row(1) + E.row(1));
  }
  Eigen::Matrix<double, 2, 20> at(double a, double b) const {
    Eigen::Matrix<double, 2, 20> out;
    out << r + (3 * b - 1) * turn, s + (1 - 3 * a) * turn;
    return out;
  }
};

ShellStrainPoint triangle_point(const ShellElement& element, const Plane& plane,
                                const OptimalMembrane& membrane, const TriangleShear& shear,
                                const ShellRulePoint& at) {
  ShellStrainPoint out;
  out.area = 2 * plane.area * at.weight;
  out.outer.resize(8, 18);
  out.outer.topRows<3>() = membrane.at({1 - at.r - at.s, at.r, at.s});
  set_curvature(element, plane.axes, plane.slope, out.outer);
  const Eigen::Matrix<double, 2, 20> gamma = plane.inverse.transpose() * shear.at(at.r, at.s);
  out.outer.bottomRows<2>() = gamma.leftCols<18>();
  out.inner.bottomLeftCorner<2, 2>() = gamma.rightCols<2>();
  const Eigen::Vector2d natural(27 * at.s * (1 - 2 * at.r - at.s),
                                27 * at.r * (1 - at.r - 2 * at.s));
  const Eigen::Vector2d g = plane.inverse.transpose() * natural;
  out.inner(3, 0) = out.inner(5, 1) = g.x();
  out.inner(4, 1) = out.inner(5, 0) = g.y();
  return out;
}

}  // namespace

ShellStrainField triangle_strain(const ShellElement& element, bool with_corners) {
  const Plane plane(element);
  const OptimalMembrane membrane(element, plane);
  const TriangleShear shear(element, plane);
  ShellStrainField out;
  out.num_inner = 2;
  for (const ShellRulePoint& at : triangle_rule_of_degree_4()) {
    out.points.push_back(triangle_point(element, plane, membrane, shear, at));
  }
  out.centre = triangle_point(element, plane, membrane, shear, {1.0 / 3, 1.0 / 3, 0});
  out.centre_axes = plane.axes;
  if (!with_corners) return out;
  for (const auto& [r, s] : {std::array{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}) {
    out.corners.push_back(triangle_point(element, plane, membrane, shear, {r, s, 0}));
    out.corner_axes.push_back(plane.axes);
  }
  return out;
}

TriangleDrilling triangle_drilling(const ShellElement& element) {
  const Plane plane(element);
  const Eigen::Matrix<double, 3, 18> turn = relative_rotation(element, plane);
  return {{ShellRow(turn.row(0)), ShellRow(turn.row(1)), ShellRow(turn.row(2))}, plane.area};
}

}  // namespace buckens::fem
