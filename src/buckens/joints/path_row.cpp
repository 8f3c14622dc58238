// SPDX-License-Identifier: Apache-2.0
#include "buckens/joints/path_row.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::joints {

using Eigen::Vector3d;
using spatial::MarkerBias;
using spatial::MarkerMotion;

namespace {

// How far beyond an end counts as rounding, of the curve's length.
constexpr double kRounding = 1e-9;
constexpr int kDirections = 200;
constexpr int kSamples = 500;

/// The direction that a curve stays farthest away from: across it are two more.
Vector3d direction_aside(const SpaceCurve& curve) {
  std::vector<Vector3d> tangents;
  for (int k = 0; k <= kSamples; ++k) {
    tangents.push_back(curve.at(curve.length() * k / kSamples).tangent.normalized());
  }
  Vector3d best = Vector3d::UnitZ();
  double most = -1.0;
  for (int k = 0; k < kDirections; ++k) {
    // Evenly over half of a sphere (Fibonacci's lattice): the other half has the same lines.
    const double z = (k + 0.5) / kDirections;
    const double angle = 2.399963229728653 * k;
    const double r = std::sqrt(1.0 - z * z);
    const Vector3d direction(r * std::cos(angle), r * std::sin(angle), z);
    double least = 1.0;
    for (const Vector3d& t : tangents) least = std::min(least, t.cross(direction).norm());
    if (least <= most) continue;
    most = least;
    best = direction;
  }
  return best;
}

}  // namespace

PathRow::PathRow(std::shared_ptr<const SpaceCurve> curve, const std::optional<Vector3d>& normal,
                 int number)
    : curve_(std::move(curve)),
      across_(normal.value_or(Vector3d::Zero())),
      hint_(normal ? *normal : direction_aside(*curve_)),
      number_(number) {}

CurveTouch PathRow::look(const MarkerMotion& F, const MarkerMotion& M, const double* states) const {
  CurveTouch out;
  out.place = F.R.transpose() * (M.p - F.p);
  const bool is_known = states != nullptr && states[0] > 0.0;
  out.s = is_known ? curve_->nearest(out.place, across_, states[1])
                   : curve_->nearest(out.place, across_);
  out.at = curve_->at(out.s);
  const Vector3d first = hint_.cross(out.at.tangent).normalized();
  out.n = number_ == 0 ? first : Vector3d(out.at.tangent.normalized().cross(first));
  return out;
}

RowValue PathRow::evaluate(const MarkerMotion& F, const MarkerMotion& M, double /*t*/,
                           const double* states) const {
  const CurveTouch at = look(F, M, states);
  RowValue out;
  out.g = at.gap();
  out.J = at.derivatives(F, M);
  return out;
}

double PathRow::bias(const MarkerMotion& F, const MarkerMotion& M, const MarkerBias& bias_F,
                     const MarkerBias& bias_M, double /*t*/, const double* states) const {
  return look(F, M, states).bias(F, M, bias_F, bias_M, across_);
}

void PathRow::follow(const MarkerMotion& F, const MarkerMotion& M, double /*lambda*/, double /*t*/,
                     const double* before, double* after) const {
  const double s = look(F, M, before).s;
  const double length = curve_->length();
  if (!curve_->is_closed() && (s < -kRounding * length || s > (1.0 + kRounding) * length)) {
    throw NumericalError(fmt::format(
        "the point has left its path beyond the {} of {:.6g} m of it; lengthen `path`, or hold the "
        "point back by a stop",
        s < 0.0 ? "start" : "end", length));
  }
  after[0] = 1.0;
  after[1] = curve_->is_closed() ? s - length * std::floor(s / length) : s;
}

std::vector<std::shared_ptr<const RowLaw>> make_path_rows(
    const std::shared_ptr<const SpaceCurve>& curve, const std::optional<Vector3d>& normal) {
  std::vector<std::shared_ptr<const RowLaw>> out;
  if (normal) {
    const Vector3d across = unit_normal(*curve, *normal);
    out.push_back(std::make_shared<PathRow>(curve, across, 0));
    return out;
  }
  for (const int number : {0, 1}) {
    out.push_back(std::make_shared<PathRow>(curve, std::nullopt, number));
  }
  return out;
}

}  // namespace buckens::joints
