// SPDX-License-Identifier: Apache-2.0
#include "buckens/joints/rolled_way.h"

#include <cmath>
#include <numbers>

namespace buckens::joints {

using Eigen::Vector3d;
using spatial::MarkerBias;
using spatial::MarkerMotion;

RolledWay::RolledWay(const RollingRow::Data& data, const Eigen::Matrix3d& R_FM_placed,
                     bool is_angle)
    : data_(data), is_angle_(is_angle), scale_(is_angle ? 1.0 : data.radius) {
  MarkerMotion F, M;
  M.R = R_FM_placed;
  mark_M_ = R_FM_placed.transpose() * RollingRow::stand(data_, F, M).ahead;
}

CoordinateLook RolledWay::look(const MarkerMotion& F, const MarkerMotion& M,
                               const CountedValue* before) const {
  const RollingRow::Stand at = RollingRow::stand(data_, F, M);
  const Vector3d mark = M.R * mark_M_;
  // −e, ahead and a are a frame: a × ahead = −e.
  const double angle = std::atan2(-mark.dot(at.e), mark.dot(at.ahead));
  CoordinateLook out;
  out.fraction = scale_ * angle;
  if (!is_angle_ && before != nullptr) {
    const double turn = 2.0 * std::numbers::pi * scale_;
    out.fraction += turn * std::round((before->fraction - out.fraction) / turn);
  }
  const Vector3d about = scale_ * (at.a - at.tilt / at.lean * at.e);
  out.J.segment<3>(0) = -about.transpose();
  out.J.segment<3>(6) = about.transpose();
  out.rate = about.dot(M.w - F.w);
  return out;
}

double RolledWay::bias(const MarkerMotion& F, const MarkerMotion& M, const MarkerBias& bias_F,
                       const MarkerBias& bias_M, const CountedValue* /*before*/) const {
  const RollingRow::Stand at = RollingRow::stand(data_, F, M);
  const RollingRow::StandRates rate = RollingRow::rates(at, F, M);
  const double slope = at.tilt / at.lean;
  const double slope_rate = (rate.tilt - slope * rate.lean) / at.lean;
  const Vector3d about = at.a - slope * at.e;
  const Vector3d about_rate = rate.a - slope_rate * at.e - slope * rate.e;
  return scale_ * (about.dot(bias_M.alpha - bias_F.alpha) + about_rate.dot(M.w - F.w));
}

}  // namespace buckens::joints
