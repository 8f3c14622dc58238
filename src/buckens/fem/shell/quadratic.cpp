// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/shell/quadratic.h"

#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "buckens/fem/shell/covariant.h"
#include "buckens/fem/shell/turn.h"

namespace buckens::fem {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

// Elements count as curved from |n_i − n| l/h = 0.01 on. Already from 0.1 on, strains of the
// displacements hold thin shells by some per cent of their bending.
constexpr double kCurved = 1e4;

/// ε_x, ε_y, γ_xy from ε_rr, ε_ss, 2 ε_rs.
/// @param i ∂(r, s)/∂(x, y)
Matrix3d from_natural(const Matrix2d& i) {
  Matrix3d T;
  T << i(0, 0) * i(0, 0), i(1, 0) * i(1, 0), i(0, 0) * i(1, 0),  //
      i(0, 1) * i(0, 1), i(1, 1) * i(1, 1), i(0, 1) * i(1, 1),   //
      2 * i(0, 0) * i(0, 1), 2 * i(1, 0) * i(1, 1), i(0, 0) * i(1, 1) + i(1, 0) * i(0, 1);
  return T;
}

struct PointAndAxes {
  ShellStrainPoint point;
  Matrix3d axes;
};

/// An element with all that its strains at a point need.
struct Quadratic {
  const ShellElement& element;
  CovariantStrain covariant;
  TiedStrain tied;
  double drilling = 1;   // drilling_share()
  double displaced = 1;  // share of the membrane strains that the displacements have

  explicit Quadratic(const ShellElement& own)
      : element(own), covariant(own), tied(covariant, own.is_triangle()) {
    const double centre = own.is_triangle() ? 1.0 / 3 : 0.0;
    const CovariantStrain::Point p = covariant.at(centre, centre);
    const Vector3d normal = p.tangents.col(0).cross(p.tangents.col(1));
    drilling =
        drilling_share(own, normal.normalized(), (own.is_triangle() ? 1 : 4) * normal.norm());
    displaced = 1 / (1 + kCurved * (1 / drilling - 1));
  }

  PointAndAxes at(const ShellRulePoint& place) const;

 private:
  void set_drilling(const CovariantStrain::Point& p, const Matrix3d& axes, const Matrix2d& inverse,
                    ShellStrainPoint& out) const;
};

/// As that of quadrilaterals with four nodes: Σ N_i m_i·(θ_i − ω), m_i between the normal of the
/// point and the director of node i.
void Quadratic::set_drilling(const CovariantStrain::Point& p, const Matrix3d& axes,
                             const Matrix2d& inverse, ShellStrainPoint& out) const {
  const Eigen::Index n = covariant.num_nodal();
  const ShellSlope slope = inverse.transpose() * p.shape.slope;
  const Eigen::Vector2d bubble = inverse.transpose() * p.bubble_slope;
  const Vector3d normal = axes.col(2);
  CovariantStrain::Rows<1> row = CovariantStrain::Rows<1>::Zero(1, covariant.num_columns());
  Vector3d mean = Vector3d::Zero();
  for (Eigen::Index i = 0; i < element.nodes.cols(); ++i) {
    const Vector3d between = 0.5 * (normal + element.directors.col(i));
    row.segment<3>(6 * i + 3) += p.shape.N[i] * between.transpose();
    mean += p.shape.N[i] * between;
  }
  const Vector3d m = axes.transpose() * mean;
  const auto add = [&](const Vector3d& vector, Eigen::Index along) {
    covariant.add_surface(row, vector, slope.row(along), bubble[along]);
  };
  add(-m.x() * normal, 1);
  add(m.y() * normal, 0);
  add(-0.5 * m.z() * axes.col(1), 0);
  add(0.5 * m.z() * axes.col(0), 1);
  out.drilling = row.head(n);
  out.inner_drilling.head(covariant.num_inner()) = row.tail(covariant.num_inner());
}

PointAndAxes Quadratic::at(const ShellRulePoint& place) const {
  const CovariantStrain::Point p = covariant.at(place.r, place.s);
  PointAndAxes out;
  out.axes = shell_axes(element, p.tangents);
  const Matrix2d jacobian = out.axes.leftCols<2>().transpose() * p.tangents;
  const Matrix2d inverse = jacobian.inverse();
  out.point.area = place.weight * jacobian.determinant();
  const Matrix3d T = from_natural(inverse);
  CovariantStrain::Rows<8> rows(8, covariant.num_columns());
  rows.topRows<3>() = displaced * T * covariant.membrane(p);
  if (displaced < 1) rows.topRows<3>() += (1 - displaced) * T * tied.membrane(place.r, place.s);
  rows.middleRows<3>(3) = T * covariant.curvature(p);
  rows.bottomRows<2>() = inverse.transpose() * tied.shear(place.r, place.s);
  out.point.outer = rows.leftCols(covariant.num_nodal());
  out.point.inner.leftCols(covariant.num_inner()) = rows.rightCols(covariant.num_inner());
  set_drilling(p, out.axes, inverse, out.point);
  return out;
}

/// Places from which strains are extrapolated.
std::vector<ShellRulePoint> sampling_places(bool is_triangle) {
  if (!is_triangle) return shell_rule(false, 2);
  return {{1.0 / 6, 1.0 / 6, 0}, {2.0 / 3, 1.0 / 6, 0}, {1.0 / 6, 2.0 / 3, 0}};
}

/// Share of each of them at a point: bilinear, or linear.
std::vector<double> sampling_shares(bool is_triangle, double r, double s) {
  if (is_triangle) return {5.0 / 3 - 2 * r - 2 * s, 2 * r - 1.0 / 3, 2 * s - 1.0 / 3};
  std::vector<double> out;
  for (const ShellRulePoint& at : sampling_places(false)) {
    out.push_back(0.25 * (1 + 3 * at.r * r) * (1 + 3 * at.s * s));
  }
  return out;
}

/// Strains at a point from those of the sampling points, turned into its axes.
ShellStrainPoint extrapolated(const std::vector<PointAndAxes>& samples,
                              const std::vector<double>& shares, const Matrix3d& axes) {
  ShellStrainPoint out;
  out.outer = ShellStrain::Zero(8, samples.front().point.outer.cols());
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double angle = turn_between(samples[k].axes, axes);
    Eigen::Matrix<double, 8, 8> T = Eigen::Matrix<double, 8, 8>::Zero();
    T.topLeftCorner<3, 3>() = T.block<3, 3>(3, 3) = strain_in_other_axes(angle);
    T.bottomRightCorner<2, 2>() << std::cos(angle), -std::sin(angle), std::sin(angle),
        std::cos(angle);
    out.outer.noalias() += shares[k] * T * samples[k].point.outer;
    out.inner.noalias() += shares[k] * T * samples[k].point.inner;
  }
  return out;
}

}  // namespace

ShellStrainField quadratic_strain(const ShellElement& element, ShellStrainPlaces places) {
  const Quadratic quadratic(element);
  const bool is_triangle = element.is_triangle();
  ShellStrainField out;
  out.num_inner = quadratic.covariant.num_inner();
  out.drilling_share = quadratic.drilling;
  for (const ShellRulePoint& at :
       is_triangle ? triangle_rule_of_degree_4() : shell_rule(false, 3)) {
    out.points.push_back(quadratic.at(at).point);
  }
  if (places == ShellStrainPlaces::none) return out;
  std::vector<PointAndAxes> samples;
  for (const ShellRulePoint& at : sampling_places(is_triangle)) samples.push_back(quadratic.at(at));
  const auto axes_at = [&](double r, double s) {
    return shell_axes(element, quadratic.covariant.at(r, s).tangents);
  };
  const double centre = is_triangle ? 1.0 / 3 : 0.0;
  out.centre_axes = axes_at(centre, centre);
  out.centre = extrapolated(samples, sampling_shares(is_triangle, centre, centre), out.centre_axes);
  if (places == ShellStrainPlaces::centre) return out;
  for (const auto& [r, s] : shell_node_places(element.nodes.cols())) {
    out.corner_axes.push_back(axes_at(r, s));
    out.corners.push_back(
        extrapolated(samples, sampling_shares(is_triangle, r, s), out.corner_axes.back()));
  }
  return out;
}

}  // namespace buckens::fem
