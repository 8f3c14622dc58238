// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/differenced_force.h"

#include <algorithm>
#include <cmath>

#include "buckens/spatial/principal_axes.h"

namespace buckens::loads {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using spatial::MarkerMotion;

namespace {

// Balances rounding, about 1e-16 of the argument over the increment, against the curvature of the
// law; central differences of laws up to second degree have no other error.
constexpr double kIncrement = 1e-6;

double increment(double argument) { return kIncrement * std::max(1.0, std::abs(argument)); }

/// −∂F/∂x of the law, where x is a member of the marker's motion.
Matrix3d resistance(const FunctionForce::Law& law, double t, const MarkerMotion& marker,
                    Vector3d MarkerMotion::*argument) {
  Matrix3d out;
  MarkerMotion moved = marker;
  for (int k = 0; k < 3; ++k) {
    const double value = (marker.*argument)[k];
    const double delta = increment(value);
    (moved.*argument)[k] = value + delta;
    const Vector3d beyond = law(t, moved);
    (moved.*argument)[k] = value - delta;
    out.col(k) = (law(t, moved) - beyond) / (2 * delta);
    (moved.*argument)[k] = value;
  }
  return out;
}

/// A row along each principal direction of the symmetric part; its resistance at least zero.
void append_principal_rows(const Matrix3d& resistance, double SoftRow::*strength,
                           std::vector<SoftRow>& rows) {
  const Matrix3d symmetric = 0.5 * (resistance + resistance.transpose());
  spatial::PrincipalAxes principal;
  const bool is_usable = symmetric.allFinite();
  if (is_usable) principal = spatial::principal_axes(symmetric);
  for (int k = 0; k < 3; ++k) {
    SoftRow row;
    const Vector3d direction = is_usable ? Vector3d(principal.vectors.col(k)) : Vector3d::Unit(k);
    row.J.segment<3>(3) = direction.transpose();
    row.*strength = is_usable ? std::max(0.0, principal.values[k]) : 0.0;
    rows.push_back(row);
  }
}

}  // namespace

void DifferencedForce::append_soft_rows(const MarkerMotion& first, const MarkerMotion& /*second*/,
                                        std::vector<SoftRow>& rows) const {
  append_rows(0.0, first, rows);
}

void DifferencedForce::append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const {
  append_rows(sight.t, sight.first, rows);
}

void DifferencedForce::append_rows(double t, const MarkerMotion& first,
                                   std::vector<SoftRow>& rows) const {
  append_principal_rows(resistance(law_, t, first, &MarkerMotion::p), &SoftRow::stiffness, rows);
  append_principal_rows(resistance(law_, t, first, &MarkerMotion::v), &SoftRow::damping, rows);
}

}  // namespace buckens::loads
