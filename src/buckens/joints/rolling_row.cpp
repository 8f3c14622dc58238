// SPDX-License-Identifier: Apache-2.0
#include "buckens/joints/rolling_row.h"

#include <cmath>

#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::joints {

using Eigen::Vector3d;
using spatial::MarkerBias;
using spatial::MarkerMotion;

namespace {

// Sine of the angle between the wheel and the plane below which its lowest place is not known.
constexpr double kFlat = 1e-6;

}  // namespace

struct RollingRow::View : RollingRow::Stand {
  Vector3d rho, x;  // from the centre, and from F, to the contact
  Vector3d d;       // direction of the row
};

RollingRow::Stand RollingRow::stand(const Data& data, const MarkerMotion& F,
                                    const MarkerMotion& M) {
  Stand out;
  out.n = F.R * data.normal_F;
  out.a = M.R * data.axis_M;
  out.tilt = out.a.dot(out.n);
  const Vector3d across = out.n - out.tilt * out.a;
  out.lean = across.norm();
  if (!(out.lean > kFlat)) {
    throw NumericalError(
        "the wheel lies flat on its plane: its place of contact is not defined there; stop before, "
        "or use a `planar` joint for a disc that lies down");
  }
  out.e = across / out.lean;
  out.ahead = out.a.cross(out.n) / out.lean;
  return out;
}

RollingRow::StandRates RollingRow::rates(const Stand& at, const MarkerMotion& F,
                                         const MarkerMotion& M) {
  StandRates out;
  out.n = F.w.cross(at.n);
  out.a = M.w.cross(at.a);
  out.tilt = out.a.dot(at.n) + at.a.dot(out.n);
  out.lean = -at.tilt * out.tilt / at.lean;
  out.e = (out.n - out.tilt * at.a - at.tilt * out.a - out.lean * at.e) / at.lean;
  return out;
}

RollingRow::View RollingRow::look(const MarkerMotion& F, const MarkerMotion& M) const {
  View out{stand(data_, F, M), {}, {}, {}};
  out.rho = -(data_.radius - data_.edge) * out.e - data_.edge * out.n;
  out.x = M.p - F.p + out.rho;
  out.d = direction_ == Direction::normal  ? out.n
          : direction_ == Direction::ahead ? out.ahead
                                           : out.n.cross(out.ahead);
  return out;
}

RowValue RollingRow::evaluate(const MarkerMotion& F, const MarkerMotion& M, double /*t*/,
                              const double* /*states*/) const {
  const View at = look(F, M);
  RowValue out;
  if (direction_ == Direction::normal) out.g = at.n.dot(at.x);
  out.J << -at.x.cross(at.d).transpose(), -at.d.transpose(), at.rho.cross(at.d).transpose(),
      at.d.transpose();
  return out;
}

double RollingRow::bias(const MarkerMotion& F, const MarkerMotion& M, const MarkerBias& bias_F,
                        const MarkerBias& bias_M, double /*t*/, const double* /*states*/) const {
  const View at = look(F, M);
  const auto [n_dot, a_dot, tilt_dot, lean_dot, e_dot] = rates(at, F, M);
  const Vector3d rho_dot = -(data_.radius - data_.edge) * e_dot - data_.edge * n_dot;
  const Vector3d x_dot = M.v - F.v + rho_dot;
  const Vector3d ahead_dot =
      (a_dot.cross(at.n) + at.a.cross(n_dot) - lean_dot * at.ahead) / at.lean;
  const Vector3d d_dot = direction_ == Direction::normal ? n_dot
                         : direction_ == Direction::ahead
                             ? ahead_dot
                             : Vector3d(n_dot.cross(at.ahead) + at.n.cross(ahead_dot));
  const Vector3d slip = M.v + M.w.cross(at.rho) - F.v - F.w.cross(at.x);
  const Vector3d slip_rate = bias_M.a + bias_M.alpha.cross(at.rho) + M.w.cross(rho_dot) - bias_F.a -
                             bias_F.alpha.cross(at.x) - F.w.cross(x_dot);
  return d_dot.dot(slip) + at.d.dot(slip_rate);
}

void RollingRow::follow(const MarkerMotion& F, const MarkerMotion& M, double /*lambda*/,
                        double /*t*/, const double* /*before*/, double* /*after*/) const {
  look(F, M);
}

}  // namespace buckens::joints
