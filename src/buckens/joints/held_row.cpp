// SPDX-License-Identifier: Apache-2.0
#include "buckens/joints/held_row.h"

#include <Eigen/Geometry>

#include "buckens/joints/relative_turn.h"

namespace buckens::joints {

using Eigen::Vector3d;
using spatial::MarkerBias;
using spatial::MarkerMotion;

namespace {

void store(const Vector3d& value, double* states) {
  states[0] = 1.0;
  for (int k = 0; k < 3; ++k) states[k + 1] = value[k];
}

}  // namespace

HeldRow HeldRow::place(const Vector3d& e_F, const Vector3d& r_F) {
  HeldRow out;
  out.b_F_ = e_F;
  out.placed_ = r_F;
  return out;
}

HeldRow HeldRow::turn(const Vector3d& b_F, const Vector3d& c_F, const Eigen::Matrix3d& R_FM) {
  HeldRow out;
  out.is_place_ = false;
  out.b_F_ = b_F;
  out.c_F_ = c_F;
  out.placed_ = R_FM.transpose() * c_F;
  return out;
}

Vector3d HeldRow::held(const double* states) const {
  if (states == nullptr || states[0] == 0.0) return placed_;
  return {states[1], states[2], states[3]};
}

RowValue HeldRow::evaluate(const MarkerMotion& F, const MarkerMotion& M, double /*t*/,
                           const double* states) const {
  RowValue out;
  const Vector3d b = F.R * b_F_;
  if (is_place_) {
    const Vector3d r = M.p - F.p;
    out.g = b.dot(r) - b_F_.dot(held(states));
    out.J.segment<3>(0) = b.cross(r).transpose();
    out.J.segment<3>(3) = -b.transpose();
    out.J.segment<3>(9) = b.transpose();
    return out;
  }
  const Vector3d c = M.R * held(states);
  out.g = b.dot(c);
  out.J.segment<3>(0) = b.cross(c).transpose();
  out.J.segment<3>(6) = -b.cross(c).transpose();
  return out;
}

double HeldRow::bias(const MarkerMotion& F, const MarkerMotion& M, const MarkerBias& bias_F,
                     const MarkerBias& bias_M, double /*t*/, const double* states) const {
  const Vector3d b = F.R * b_F_;
  if (is_place_) return b.dot(relative_bias(F, M, bias_F, bias_M));
  const Vector3d c = M.R * held(states);
  const Vector3d b_dot = F.w.cross(b);
  const Vector3d c_dot = M.w.cross(c);
  return (bias_F.alpha.cross(b) + F.w.cross(b_dot)).dot(c) + 2.0 * b_dot.dot(c_dot) +
         b.dot(bias_M.alpha.cross(c) + M.w.cross(c_dot));
}

void HeldRow::follow(const MarkerMotion& /*F*/, const MarkerMotion& /*M*/, double /*lambda*/,
                     double /*t*/, const double* before, double* after) const {
  store(held(before), after);
}

void HeldRow::attach(const MarkerMotion& F, const MarkerMotion& M, double /*t*/,
                     double* states) const {
  store(is_place_ ? Vector3d(F.R.transpose() * (M.p - F.p))
                  : Vector3d(M.R.transpose() * (F.R * c_F_)),
        states);
}

}  // namespace buckens::joints
