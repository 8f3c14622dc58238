// SPDX-License-Identifier: Apache-2.0
#include "buckens/joints/path_coordinate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "buckens/joints/relative_turn.h"

namespace buckens::joints {

using Eigen::Vector3d;
using spatial::MarkerBias;
using spatial::MarkerMotion;

namespace {

// Gauss's rule of five points on [0, 1]; with so many parts between two points of a spline it
// leaves nothing but rounding.
constexpr std::array<double, 5> kGaussPlaces = {0.04691007703066800, 0.23076534494715845, 0.5,
                                                0.76923465505284155, 0.95308992296933200};
constexpr std::array<double, 5> kGaussWeights = {0.11846344252809454, 0.23931433524968324,
                                                 0.28444444444444444, 0.23931433524968324,
                                                 0.11846344252809454};
constexpr int kPartsOfPiece = 8;
// Of the curve's length: a point that is farther away has been let go, and will come back anywhere.
constexpr double kOffCurve = 1e-3;
// Of |c′|²: at a centre of curvature, where only such a point comes to, it would be zero.
constexpr double kLeastSteep = 0.1;

}  // namespace

PathCoordinate::PathCoordinate(std::shared_ptr<const SpaceCurve> curve, const Vector3d& across,
                               const Vector3d& r_F_placed)
    : curve_(std::move(curve)), across_(across) {
  const std::vector<double>& knots = curve_->knots();
  parameters_.push_back(0.0);
  ways_.push_back(0.0);
  for (std::size_t k = 1; k < knots.size(); ++k) {
    for (int part = 1; part <= kPartsOfPiece; ++part) {
      const double to = knots[k - 1] + (knots[k] - knots[k - 1]) * part / kPartsOfPiece;
      ways_.push_back(ways_.back() + length_between(parameters_.back(), to));
      parameters_.push_back(to);
    }
  }
  start_ = way(curve_->nearest(r_F_placed, across_));
}

double PathCoordinate::length_between(double from, double to) const {
  double out = 0.0;
  for (std::size_t k = 0; k < kGaussPlaces.size(); ++k) {
    const double u = from + kGaussPlaces[k] * (to - from);
    out += kGaussWeights[k] * flat(curve_->at(u).tangent).norm();
  }
  return out * (to - from);
}

double PathCoordinate::way(double u) const {
  const double length = curve_->length();
  const double laps = curve_->is_closed() ? std::floor(u / length) : 0.0;
  const double inside = u - laps * length;
  if (inside < 0.0 || inside > length) {  // beyond the end of an open curve it is straight
    const double end = inside < 0.0 ? 0.0 : length;
    return (inside < 0.0 ? 0.0 : lap()) + (inside - end) * flat(curve_->at(end).tangent).norm();
  }
  const auto next = std::upper_bound(parameters_.begin() + 1, parameters_.end() - 1, inside);
  const auto k = static_cast<std::size_t>(next - parameters_.begin()) - 1;
  return laps * lap() + ways_[k] + length_between(parameters_[k], inside);
}

double PathCoordinate::parameter_near(double way) const {
  const double laps = curve_->is_closed() ? std::floor(way / lap()) : 0.0;
  const double inside = way - laps * lap();
  const auto next = std::upper_bound(ways_.begin() + 1, ways_.end() - 1, inside);
  const auto k = static_cast<std::size_t>(next - ways_.begin()) - 1;
  const double share = (inside - ways_[k]) / (ways_[k + 1] - ways_[k]);
  return laps * curve_->length() + parameters_[k] + share * (parameters_[k + 1] - parameters_[k]);
}

PathCoordinate::Place PathCoordinate::place(const MarkerMotion& F, const MarkerMotion& M,
                                            const CountedValue* before) const {
  Place out;
  const Vector3d at = F.R.transpose() * (M.p - F.p);
  const auto look_at = [&](double u) {
    const CurvePoint c = curve_->at(u);
    out.u = u;
    out.tangent = flat(c.tangent);
    out.curvature = flat(c.curvature);
    out.off = flat(at - c.p);
  };
  if (before == nullptr) {
    look_at(curve_->nearest(at, across_));
  } else {
    const double last = start_ + before->fraction;
    look_at(curve_->nearest(at, across_, parameter_near(last)));
    if (out.off.norm() > kOffCurve * curve_->length()) {
      const double u = curve_->nearest(at, across_);
      const double laps = curve_->is_closed() ? std::round((last - way(u)) / lap()) : 0.0;
      look_at(u + laps * curve_->length());
    }
  }
  const double steep = out.tangent.squaredNorm();
  out.steep = std::max(steep - out.off.dot(out.curvature), kLeastSteep * steep);
  return out;
}

CoordinateLook PathCoordinate::look(const MarkerMotion& F, const MarkerMotion& M,
                                    const CountedValue* before) const {
  const Place at = place(F, M, before);
  CoordinateLook out;
  out.fraction = way(at.u) - start_;
  if (before == nullptr && curve_->is_closed()) {
    out.fraction = std::remainder(out.fraction, lap());
  }
  const Vector3d e = F.R * (at.tangent.norm() / at.steep * at.tangent);
  out.J.segment<3>(0) = e.cross(M.p - F.p).transpose();
  out.J.segment<3>(3) = -e.transpose();
  out.J.segment<3>(9) = e.transpose();
  out.take_rate(F, M);
  return out;
}

double PathCoordinate::bias(const MarkerMotion& F, const MarkerMotion& M, const MarkerBias& bias_F,
                            const MarkerBias& bias_M, const CountedValue* before) const {
  const Place at = place(F, M, before);
  const Vector3d rate = F.R.transpose() * (M.v - F.v - F.w.cross(M.p - F.p));
  const Vector3d change = F.R.transpose() * relative_bias(F, M, bias_F, bias_M);
  const double u_dot = at.tangent.dot(rate) / at.steep;
  // Of c′·(ρ − c) = 0, twice. What c‴ adds has the factor ρ − c, which the joint keeps at zero.
  const double steep_dot = 3.0 * at.tangent.dot(at.curvature) * u_dot - rate.dot(at.curvature);
  const double u_ddot =
      (at.curvature.dot(rate) * u_dot + at.tangent.dot(change) - steep_dot * u_dot) / at.steep;
  const double speed = at.tangent.norm();
  return speed * u_ddot + at.tangent.dot(at.curvature) / speed * u_dot * u_dot;
}

}  // namespace buckens::joints
