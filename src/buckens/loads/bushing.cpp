// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/bushing.h"

#include <cmath>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/spatial/rotation.h"

namespace buckens::loads {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using spatial::MarkerMotion;

namespace {

// Share of the largest rotational stiffness that counts as resistance against a turn.
constexpr double kResists = 0.01;

/// The rotation vector changes its sign at half a turn: beyond it the bushing would unwind.
void require_measurable(const Vector3d& theta, const Vector3d& stiffness) {
  const double angle = theta.norm();
  if (angle <= Bushing::kLargestAngle) return;
  const double resistance = stiffness.dot(theta.cwiseAbs2()) / (angle * angle);
  if (resistance <= kResists * stiffness.maxCoeff()) return;
  throw NumericalError(
      fmt::format("a bushing is turned by {:.4g} rad against its rotational stiffness, more than "
                  "the {} rad it can measure; limit the motion, or set the stiffness about the "
                  "axis that turns freely to zero",
                  angle, Bushing::kLargestAngle));
}

}  // namespace

Bushing::Bushing(const Coefficients& coefficients, const Matrix3d& R_FM_placed,
                 const Vector3d& r_F_placed)
    : k_(coefficients), R_MF_placed_(R_FM_placed.transpose()), r_F_placed_(r_F_placed) {}

Action Bushing::evaluate(double /*t*/, const MarkerMotion& first,
                         const MarkerMotion& second) const {
  const Matrix3d R_FW = first.R.transpose();
  const Vector3d arm = second.p - first.p;
  const Vector3d r = R_FW * arm - r_F_placed_;
  const Vector3d r_dot = R_FW * (second.v - first.v - first.w.cross(arm));
  const Vector3d theta =
      spatial::log_rotation(Eigen::Quaterniond(Matrix3d(R_FW * second.R * R_MF_placed_)));
  require_measurable(theta, k_.rotational_stiffness);
  const Vector3d w = R_FW * (second.w - first.w);

  const Vector3d elastic_force = k_.stiffness.cwiseProduct(r);
  const Vector3d viscous_force = k_.damping.cwiseProduct(r_dot);
  const Vector3d elastic_moment = k_.rotational_stiffness.cwiseProduct(theta);
  const Vector3d elastic_torque =
      spatial::left_jacobian(theta).transpose().partialPivLu().solve(elastic_moment);
  const Vector3d viscous_torque = k_.rotational_damping.cwiseProduct(w);

  Action action;
  const Vector3d force = -(first.R * (elastic_force + viscous_force));
  const Vector3d torque = -(first.R * (elastic_torque + viscous_torque));
  action.on_second = {torque, force};
  action.on_first = {-torque - arm.cross(force), -force};
  action.stored_energy = 0.5 * (r.dot(elastic_force) + theta.dot(elastic_moment));
  action.dissipation = r_dot.dot(viscous_force) + w.dot(viscous_torque);
  action.active_power = -action.dissipation;
  return action;
}

void Bushing::append_soft_rows(const MarkerMotion& first, const MarkerMotion& second,
                               std::vector<SoftRow>& rows) const {
  const Vector3d arm = second.p - first.p;
  for (int i = 0; i < 3; ++i) {
    const Vector3d e = first.R.col(i);
    SoftRow row;
    row.J.segment<3>(0) = e.cross(arm).transpose();
    row.J.segment<3>(3) = -e.transpose();
    row.J.segment<3>(9) = e.transpose();
    row.stiffness = k_.stiffness[i];
    row.damping = k_.damping[i];
    rows.push_back(row);
  }
  for (int i = 0; i < 3; ++i) {
    const Vector3d e = first.R.col(i);
    SoftRow row;
    row.J.segment<3>(0) = -e.transpose();
    row.J.segment<3>(6) = e.transpose();
    row.stiffness = k_.rotational_stiffness[i];
    row.damping = k_.rotational_damping[i];
    rows.push_back(row);
  }
}

}  // namespace buckens::loads
