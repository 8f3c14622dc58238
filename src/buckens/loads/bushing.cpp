// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/bushing.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/loads/curve_slopes.h"
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

using Curves = std::array<std::optional<base::Characteristic>, 3>;

/// Adds what the curves give. @return the energy that they store [J]
double add_curves(const Curves& curves, const Vector3d& x, const Vector3d& rate, Vector3d& elastic,
                  Vector3d& viscous) {
  double out = 0.0;
  for (int i = 0; i < 3; ++i) {
    const auto& curve = curves[static_cast<std::size_t>(i)];
    if (!curve) continue;
    const double at_rest = curve->force(x[i], 0.0);
    elastic[i] += at_rest;
    viscous[i] += curve->force(x[i], rate[i]) - at_rest;
    out += curve->energy(x[i]);
  }
  return out;
}

double factor_at(const base::SignalLaw& law, const Sight& sight) {
  return std::max(0.0, law.value(sight.t, sight.signals));
}

}  // namespace

Bushing::Bushing(const Coefficients& coefficients, const Matrix3d& R_FM_placed,
                 const Vector3d& r_F_placed)
    : k_(coefficients),
      resists_turns_(coefficients.rotational_stiffness),
      R_MF_placed_(R_FM_placed.transpose()),
      r_F_placed_(r_F_placed) {
  const double largest = resists_turns_.maxCoeff();
  for (int i = 0; i < 3; ++i) {
    if (k_.torques[static_cast<std::size_t>(i)]) resists_turns_[i] = largest > 0.0 ? largest : 1.0;
  }
}

Bushing::Stand Bushing::look(const MarkerMotion& first, const MarkerMotion& second) const {
  const Matrix3d R_FW = first.R.transpose();
  const Vector3d arm = second.p - first.p;
  return {R_FW * arm - r_F_placed_, R_FW * (second.v - first.v - first.w.cross(arm)),
          spatial::log_rotation(Eigen::Quaterniond(Matrix3d(R_FW * second.R * R_MF_placed_))),
          R_FW * (second.w - first.w)};
}

Action Bushing::evaluate(double t, const MarkerMotion& first, const MarkerMotion& second) const {
  return respond({t, first, second});
}

Action Bushing::respond(const Sight& sight) const {
  const MarkerMotion& first = sight.first;
  const MarkerMotion& second = sight.second;
  const auto [r, r_dot, theta, w] = look(first, second);
  const Vector3d arm = second.p - first.p;
  require_measurable(theta, resists_turns_);
  Vector3d elastic_force = k_.stiffness.cwiseProduct(r);
  Vector3d viscous_force = k_.damping.cwiseProduct(r_dot);
  Vector3d elastic_moment = k_.rotational_stiffness.cwiseProduct(theta);
  Vector3d viscous_torque = k_.rotational_damping.cwiseProduct(w);
  const double linear = 0.5 * (r.dot(elastic_force) + theta.dot(elastic_moment));
  const double in_curves = add_curves(k_.forces, r, r_dot, elastic_force, viscous_force) +
                           add_curves(k_.torques, theta, w, elastic_moment, viscous_torque);
  const double stiffness = factor_at(k_.stiffness_factor, sight);
  const double damping = factor_at(k_.damping_factor, sight);
  elastic_force *= stiffness;
  elastic_moment *= stiffness;
  viscous_force *= damping;
  viscous_torque *= damping;
  const Vector3d elastic_torque =
      spatial::left_jacobian(theta).transpose().partialPivLu().solve(elastic_moment);

  Action action;
  const Vector3d force = -(first.R * (elastic_force + viscous_force));
  const Vector3d torque = -(first.R * (elastic_torque + viscous_torque));
  action.on_second = {torque, force};
  action.on_first = {-torque - arm.cross(force), -force};
  action.stored_energy = stiffness * (linear + in_curves);
  action.dissipation = r_dot.dot(viscous_force) + w.dot(viscous_torque);
  action.active_power = -action.dissipation;
  return action;
}

void Bushing::append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const {
  const MarkerMotion& first = sight.first;
  const Vector3d arm = sight.second.p - first.p;
  const Stand stand = look(first, sight.second);
  const double stiffness = factor_at(k_.stiffness_factor, sight);
  const double damping = factor_at(k_.damping_factor, sight);
  const auto push = [&](SoftRow& row, const std::optional<base::Characteristic>& curve, double x,
                        double rate) {
    add_slopes(curve, x, rate, row);
    row.stiffness *= stiffness;
    row.damping *= damping;
    rows.push_back(row);
  };
  for (int i = 0; i < 3; ++i) {
    const Vector3d e = first.R.col(i);
    SoftRow row;
    row.J.segment<3>(0) = e.cross(arm).transpose();
    row.J.segment<3>(3) = -e.transpose();
    row.J.segment<3>(9) = e.transpose();
    row.stiffness = k_.stiffness[i];
    row.damping = k_.damping[i];
    push(row, k_.forces[static_cast<std::size_t>(i)], stand.r[i], stand.r_dot[i]);
  }
  for (int i = 0; i < 3; ++i) {
    const Vector3d e = first.R.col(i);
    SoftRow row;
    row.J.segment<3>(0) = -e.transpose();
    row.J.segment<3>(6) = e.transpose();
    row.stiffness = k_.rotational_stiffness[i];
    row.damping = k_.rotational_damping[i];
    push(row, k_.torques[static_cast<std::size_t>(i)], stand.theta[i], stand.w[i]);
  }
}

}  // namespace buckens::loads
