// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/shell/covariant.h"

#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "buckens/linalg/small_lu.h"

namespace buckens::fem {

using Eigen::Vector3d;
using Point = CovariantStrain::Point;
template <int rows>
using Rows = CovariantStrain::Rows<rows>;

namespace {

const double kHalf = std::sqrt(1.0 / 3.0);   // of two Gauss points
const double kThird = std::sqrt(3.0 / 5.0);  // of three Gauss points
// Two Gauss points on a side of length 1, and how far the third tying point of MITC6 is from it.
const double kNear = 0.5 - 0.5 * kHalf, kFar = 0.5 + 0.5 * kHalf;

using Six = std::array<double, 6>;

/// Linear along x between ±kHalf, quadratic along y between −kThird, 0, kThird.
Six six_weights(double x, double y) {
  const double b = kThird;
  const std::array along = {0.5 * (1 - x / kHalf), 0.5 * (1 + x / kHalf)};
  const std::array across = {0.5 * y * (y - b) / (b * b), 1 - y * y / (b * b),
                             0.5 * y * (y + b) / (b * b)};
  Six out{};
  for (std::size_t k = 0; k < 6; ++k) out[k] = along[k % 2] * across[k / 2];
  return out;
}

/// Where six_weights() is one.
std::array<double, 2> six_place(std::size_t k) {
  const std::size_t pair = k / 2;
  return {k % 2 == 0 ? -kHalf : kHalf, (static_cast<double>(pair) - 1) * kThird};
}

/// Linear between the Gauss points of a side and the point kHalf away from it.
/// @param along from the first end of the side, `away` from the side to the opposite corner
std::array<double, 3> side_weights(double along, double away) {
  const double third = away / kHalf, second = (along - kNear) / (kFar - kNear);
  return {1 - second - third, second, third};
}

using Eight = Eigen::Matrix<double, 8, 1>;

/// Assumed covariant shear of a triangle: linear functions, and (−s, r) times linear ones without
/// constant part. Along each side the tangential part is linear.
Eight shear_functions(int component, double r, double s) {
  Eight out = Eight::Zero();
  out.segment<3>(3 * component) << 1, r, s;
  out.tail<2>() = (component == 0 ? -s : r) * Eigen::Vector2d(r, s);
  return out;
}

struct ShearTie {
  double r, s;
  std::array<double, 2> direction;
};

/// Both Gauss points of each side.
const std::array<ShearTie, 6>& side_ties() {
  static const std::array<ShearTie, 6> all = {{{kNear, 0, {1, 0}},
                                               {kFar, 0, {1, 0}},
                                               {kFar, kNear, {-1, 1}},
                                               {kNear, kFar, {-1, 1}},
                                               {0, kFar, {0, 1}},
                                               {0, kNear, {0, 1}}}};
  return all;
}

/// From the values that are tied, six along the sides and two means, to the coefficients.
const Eigen::Matrix<double, 8, 8>& shear_coefficients() {
  static const Eigen::Matrix<double, 8, 8> inverse = [] {
    Eigen::Matrix<double, 8, 8> ties;
    Eigen::Index row = 0;
    for (const ShearTie& tie : side_ties()) {
      ties.row(row++) = (tie.direction[0] * shear_functions(0, tie.r, tie.s) +
                         tie.direction[1] * shear_functions(1, tie.r, tie.s))
                            .transpose();
    }
    for (int component = 0; component < 2; ++component) {
      Eight mean = Eight::Zero();
      for (const ShellRulePoint& at : triangle_rule_of_degree_4()) {
        mean += at.weight * shear_functions(component, at.r, at.s);
      }
      ties.row(row++) = mean.transpose();
    }
    return Eigen::Matrix<double, 8, 8>(linalg::general_inverse(ties));
  }();
  return inverse;
}

}  // namespace

CovariantStrain::CovariantStrain(const ShellElement& element)
    : element_(element), middle_(element.middle()) {
  const double centre = element.is_triangle() ? 1.0 / 3 : 0.0;
  const Vector3d director = at(centre, centre).director.normalized();
  across_.col(0) = director.unitOrthogonal();
  across_.col(1) = director.cross(across_.col(0));
}

Point CovariantStrain::at(double r, double s) const {
  Point p;
  p.shape = shell_shape(element_.nodes.cols(), r, s);
  if (element_.is_triangle()) {
    p.bubble = 27 * r * s * (1 - r - s);
    p.bubble_slope << 27 * s * (1 - 2 * r - s), 27 * r * (1 - r - 2 * s);
  } else {
    p.bubble = (1 - r * r) * (1 - s * s);
    p.bubble_slope << -2 * r * (1 - s * s), -2 * s * (1 - r * r);
  }
  p.tangents = middle_ * p.shape.slope.transpose();
  p.bend = element_.directors * p.shape.slope.transpose();
  p.director = element_.directors * p.shape.N;
  return p;
}

Rows<3> CovariantStrain::membrane(const Point& p) const {
  Rows<3> rows = Rows<3>::Zero(3, num_columns());
  for (int a = 0; a < 2; ++a) {
    add_surface(rows.row(a), p.tangents.col(a), p.shape.slope.row(a), p.bubble_slope[a]);
    add_surface(rows.row(2), p.tangents.col(a), p.shape.slope.row(1 - a), p.bubble_slope[1 - a]);
  }
  return rows;
}

Rows<3> CovariantStrain::curvature(const Point& p) const {
  Rows<3> rows = Rows<3>::Zero(3, num_columns());
  for (int a = 0; a < 2; ++a) {
    const auto own = p.shape.slope.row(a), other = p.shape.slope.row(1 - a);
    add_director(rows.row(a), p.tangents.col(a), own, p.bubble_slope[a]);
    add_surface(rows.row(a), p.bend.col(a), own, p.bubble_slope[a]);
    add_director(rows.row(2), p.tangents.col(a), other, p.bubble_slope[1 - a]);
    add_surface(rows.row(2), p.bend.col(a), other, p.bubble_slope[1 - a]);
  }
  return rows;
}

Rows<2> CovariantStrain::shear(const Point& p) const {
  Rows<2> rows = Rows<2>::Zero(2, num_columns());
  for (int a = 0; a < 2; ++a) {
    add_director(rows.row(a), p.tangents.col(a), p.shape.N, p.bubble);
    add_surface(rows.row(a), p.director, p.shape.slope.row(a), p.bubble_slope[a]);
  }
  return rows;
}

TiedStrain::TiedStrain(const CovariantStrain& covariant, bool is_triangle)
    : is_triangle_(is_triangle) {
  if (is_triangle) {
    tie_triangle(covariant);
  } else {
    tie_quadrilateral(covariant);
  }
}

void TiedStrain::tie_quadrilateral(const CovariantStrain& covariant) {
  for (std::size_t k = 0; k < 6; ++k) {
    const auto [along, across] = six_place(k);
    const Point at_r = covariant.at(along, across), at_s = covariant.at(across, along);
    membrane_[0].emplace_back(covariant.membrane(at_r).row(0));
    membrane_[1].emplace_back(covariant.membrane(at_s).row(1));
    shear_[0].emplace_back(covariant.shear(at_r).row(0));
    shear_[1].emplace_back(covariant.shear(at_s).row(1));
  }
  for (const double s : {-kHalf, kHalf}) {
    for (const double r : {-kHalf, kHalf}) {
      membrane_[2].emplace_back(covariant.membrane(covariant.at(r, s)).row(2));
    }
  }
}

void TiedStrain::tie_triangle(const CovariantStrain& covariant) {
  const auto strain = [&](double r, double s) { return covariant.membrane(covariant.at(r, s)); };
  for (const auto& [along, away] : {std::array{kNear, 0.0}, {kFar, 0.0}, {kNear, kHalf}}) {
    membrane_[0].emplace_back(strain(along, away).row(0));
    membrane_[1].emplace_back(strain(away, along).row(1));
    // Along the third side, at r = 1 − along − away, s = along: ε_rr + ε_ss − 2 ε_rs.
    const Rows<3> third = strain(1 - along - away, along);
    membrane_[2].emplace_back(third.row(0) + third.row(1) - third.row(2));
  }
  Rows<8> ties = Rows<8>::Zero(8, covariant.num_columns());
  Eigen::Index row = 0;
  for (const ShearTie& tie : side_ties()) {
    const Rows<2> shear = covariant.shear(covariant.at(tie.r, tie.s));
    ties.row(row++) = tie.direction[0] * shear.row(0) + tie.direction[1] * shear.row(1);
  }
  for (const ShellRulePoint& at : triangle_rule_of_degree_4()) {
    ties.bottomRows<2>() += at.weight * covariant.shear(covariant.at(at.r, at.s));
  }
  const Rows<8> coefficients = shear_coefficients() * ties;
  for (Eigen::Index k = 0; k < 8; ++k) shear_[0].emplace_back(coefficients.row(k));
}

Rows<3> TiedStrain::membrane(double r, double s) const {
  Rows<3> out = Rows<3>::Zero(3, membrane_[0].front().cols());
  if (is_triangle_) {
    const std::array weights = {side_weights(r, s), side_weights(s, r), side_weights(s, 1 - r - s)};
    for (std::size_t k = 0; k < 3; ++k) {
      for (Eigen::Index side = 0; side < 3; ++side) {
        const auto number = static_cast<std::size_t>(side);
        out.row(side) += weights[number][k] * membrane_[number][k];
      }
    }
    out.row(2) = (out.row(0) + out.row(1) - out.row(2)).eval();
    return out;
  }
  const Six along_r = six_weights(r, s), along_s = six_weights(s, r);
  for (std::size_t k = 0; k < 6; ++k) {
    out.row(0) += along_r[k] * membrane_[0][k];
    out.row(1) += along_s[k] * membrane_[1][k];
  }
  for (std::size_t k = 0; k < 4; ++k) {
    const double x = k % 2 == 0 ? -r : r, y = k / 2 == 0 ? -s : s;
    out.row(2) += 0.25 * (1 + x / kHalf) * (1 + y / kHalf) * membrane_[2][k];
  }
  return out;
}

Rows<2> TiedStrain::shear(double r, double s) const {
  Rows<2> out = Rows<2>::Zero(2, shear_[0].front().cols());
  if (is_triangle_) {
    const Eight first = shear_functions(0, r, s), second = shear_functions(1, r, s);
    for (std::size_t k = 0; k < 8; ++k) {
      out.row(0) += first[static_cast<Eigen::Index>(k)] * shear_[0][k];
      out.row(1) += second[static_cast<Eigen::Index>(k)] * shear_[0][k];
    }
    return out;
  }
  const Six along_r = six_weights(r, s), along_s = six_weights(s, r);
  for (std::size_t k = 0; k < 6; ++k) {
    out.row(0) += along_r[k] * shear_[0][k];
    out.row(1) += along_s[k] * shear_[1][k];
  }
  return out;
}

}  // namespace buckens::fem
