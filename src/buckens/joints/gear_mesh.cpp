// SPDX-License-Identifier: Apache-2.0
#include "buckens/joints/gear_mesh.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/joints/relative_turn.h"

namespace buckens::joints {

using Eigen::Vector3d;
using spatial::MarkerBias;
using spatial::MarkerMotion;

namespace {

/// Angle from x to y about an axis normal to x [rad].
double angle_between(const Vector3d& axis, const Vector3d& x, const Vector3d& y) {
  return std::atan2(axis.cross(x).dot(y), x.dot(y));
}

// A counted angle among the states of a row: turns, fraction and rate. The instant is shared.
constexpr int kAngleStates = 3;

CountedValue read_angle(const double* states, double then) {
  return {static_cast<int>(states[0]), states[1], states[2], then};
}

/// @param states null: no turns yet, @param then their instant
CountedValue counted(const double* states, double then, double fraction, double t) {
  if (states == nullptr) return {0, fraction, 0.0, t};
  return follow_turns(expected_at(read_angle(states, then), t), fraction);
}

/// @param before may be null, or `after`
void follow_angle(const CountedValue& now, const char* what, const double* before, double then,
                  double* after) {
  if (before != nullptr) require_countable(read_angle(before, then), now, kTurn, what);
  after[0] = now.turns;
  after[1] = now.fraction;
  after[2] = now.rate;
}

/// The flank that carries; that of before where nothing is carried.
double flank_after(double lambda, double before) {
  return lambda > 0.0 ? 1.0 : lambda < 0.0 ? -1.0 : before;
}

/// Derivatives of a row whose rate is n·(rate of M's place seen from F) + m·(ω_M − ω_F).
spatial::PairRow pair_row(const Vector3d& r, const Vector3d& n, const Vector3d& m) {
  spatial::PairRow J;
  J << (-r.cross(n) - m).transpose(), -n.transpose(), m.transpose(), n.transpose();
  return J;
}

}  // namespace

double transverse_angle(double pressure_angle, double helix_angle) {
  return std::atan(std::tan(pressure_angle) / std::cos(helix_angle));
}

/// Both wheels as seen across the axis, world components.
struct GearMesh::View {
  Vector3d a, u, v;  // axis, from centre to centre, and across both
  Vector3d r, x2;    // from F to M; what pointed along u on M
  double C, z;
  CountedValue first, second;  // φ₁, φ₂
  double k1, k2;               // dg/dφ
  double flank;                // s with its sign, 0: none
  double sine;                 // of the working pressure angle
  Vector3d n;                  // dg by the place of M as seen from F: the line of action
};

GearMesh::GearMesh(const Data& data) : axis_F_(data.axis_F), sizes_(data.sizes) {
  offset_ = axis_F_.dot(data.r_F);
  const Vector3d across = data.r_F - offset_ * axis_F_;
  distance_ = across.norm();
  if (!(distance_ > 1e-9 * data.r_F.norm())) {
    throw ModelError(
        "the centres of both wheels lie on one axis; place the markers at the centres of wheels "
        "that stand side by side");
  }
  u_F_ = across / distance_;
  u_M_ = data.R_FM.transpose() * u_F_;
  if (data.same_sense) sizes_[1] = -sizes_[1];
  if (!data.has_teeth) return;
  const double sum = std::abs(sizes_[0] + sizes_[1]);
  if (!(sum > 0.0)) {
    throw ModelError(
        "a gear and a ring with as many teeth have one centre, but these are apart; correct "
        "`teeth`");
  }
  const double alpha = transverse_angle(data.pressure_angle, data.helix_angle);
  base_ = distance_ / sum * std::cos(alpha);
  touching_ = distance_ * std::cos(alpha);
  axial_ = std::cos(alpha) * std::tan(data.helix_angle);
  if (data.pressure_angle > 0.0) flank_sign_ = data.same_sense ? -1.0 : 1.0;
}

GearMesh::View GearMesh::look(const MarkerMotion& F, const MarkerMotion& M, double t,
                              const double* states) const {
  View out;
  out.a = F.R * axis_F_;
  out.r = M.p - F.p;
  out.z = out.a.dot(out.r);
  const Vector3d across = out.r - out.z * out.a;
  out.C = across.norm();
  out.u = across / out.C;
  out.v = out.a.cross(out.u);
  out.x2 = M.R * u_M_;
  const double* const second = states == nullptr ? nullptr : states + kAngleStates;
  const double then = states == nullptr ? t : states[kInstant];
  out.first = counted(states, then, -angle_between(out.a, F.R * u_F_, out.u), t);
  out.second = counted(second, then, angle_between(out.a, out.u, out.x2), t);
  out.k1 = base_ * sizes_[0];
  out.k2 = base_ * sizes_[1];
  // An iteration may look at centres so near that base circles overlap; follow() refuses that.
  const bool is_apart = out.C > touching_ && flank_sign_ != 0.0;
  out.flank = states == nullptr || !is_apart ? 0.0 : flank_sign_ * states[kFlank];
  out.sine = is_apart ? std::sqrt(1.0 - std::pow(touching_ / out.C, 2)) : 0.0;
  out.n = -(out.k1 + out.k2) / out.C * out.v + out.flank * out.sine * out.u + axial_ * out.a;
  return out;
}

RowValue GearMesh::evaluate(const MarkerMotion& F, const MarkerMotion& M, double t,
                            const double* states) const {
  const View at = look(F, M, t, states);
  TurnSum turns;
  turns.add(sizes_[0], at.first);
  turns.add(sizes_[1], at.second);
  RowValue out;
  out.g = base_ * turns.value() + axial_ * (at.z - offset_);
  if (at.flank != 0.0) {
    const auto w = [this](double C) {
      return std::sqrt(C * C - touching_ * touching_) - touching_ * std::acos(touching_ / C);
    };
    out.g += at.flank * (w(at.C) - w(distance_));
  }
  out.J = pair_row(at.r, at.n, at.k2 * RelativeTurn(at.a, at.x2).derivative());
  return out;
}

double GearMesh::bias(const MarkerMotion& F, const MarkerMotion& M, const MarkerBias& bias_F,
                      const MarkerBias& bias_M, double t, const double* states) const {
  const View at = look(F, M, t, states);
  const Vector3d rate = M.v - F.v - F.w.cross(at.r);
  const double C_dot = at.u.dot(rate);
  const double turn = at.v.dot(rate) / at.C;  // of the line of centres, seen from F
  double out = at.n.dot(relative_bias(F, M, bias_F, bias_M)) +
               at.k2 * RelativeTurn(at.a, at.x2).bias(F, M, bias_F, bias_M) +
               2.0 * (at.k1 + at.k2) * C_dot * turn / at.C;
  if (at.flank != 0.0) {
    const double cosine = touching_ / at.C;
    out += at.flank *
           (at.sine * at.C * turn * turn + cosine * cosine / (at.C * at.sine) * C_dot * C_dot);
  }
  return out;
}

void GearMesh::follow(const MarkerMotion& F, const MarkerMotion& M, double lambda, double t,
                      const double* before, double* after) const {
  View at = look(F, M, t, before);
  if (flank_sign_ != 0.0 && !(at.C > touching_)) {
    throw NumericalError(fmt::format(
        "the centres of the gears have come within {:.6g} m of each other, where their base "
        "circles touch (they were placed {:.6g} m apart); hold their shafts",
        touching_, distance_));
  }
  const double turn = at.v.dot(M.v - F.v - F.w.cross(at.r)) / at.C;  // of the line of centres
  at.first.rate = -turn;
  at.second.rate = RelativeTurn(at.a, at.x2).derivative().dot(M.w - F.w) - turn;
  const double flank = before == nullptr ? 0.0 : before[kFlank];
  const double then = before == nullptr ? t : before[kInstant];
  const double* const second = before == nullptr ? nullptr : before + kAngleStates;
  follow_angle(at.first, "the speed of its first wheel", before, then, after);
  follow_angle(at.second, "the speed of its second wheel", second, then, after + kAngleStates);
  after[kInstant] = t;
  after[kFlank] = flank_after(lambda, flank);
}

RackMesh::RackMesh(const Data& data)
    : axis_F_(data.axis_F),
      x_F_(data.along_F),
      x_M_(data.R_FM.transpose() * data.along_F),
      r_F_(data.r_F) {
  const double alpha = transverse_angle(data.pressure_angle, data.helix_angle);
  const double cosine = std::cos(alpha);
  // On which side of the rack the pinion rolls follows from its sense: along = axis × side.
  const Vector3d side = data.along_F.cross(data.axis_F);
  driving_ = cosine * (-data.along_F + std::tan(data.helix_angle) * data.axis_F);
  separating_ = data.pressure_angle > 0.0 ? Vector3d(std::sin(alpha) * side) : Vector3d::Zero();
  base_ = data.radius * cosine;
}

CountedValue RackMesh::angle(const MarkerMotion& F, const MarkerMotion& M, double t,
                             const double* states) const {
  return counted(states, states == nullptr ? t : states[kInstant],
                 angle_between(F.R * axis_F_, F.R * x_F_, M.R * x_M_), t);
}

Vector3d RackMesh::line_of_action(const double* states) const {
  return driving_ + (states == nullptr ? 0.0 : states[kFlank]) * separating_;
}

RowValue RackMesh::evaluate(const MarkerMotion& F, const MarkerMotion& M, double t,
                            const double* states) const {
  const Vector3d r = M.p - F.p;
  const Vector3d n_F = line_of_action(states);
  RowValue out;
  out.g = base_ * angle(F, M, t, states).value() + n_F.dot(F.R.transpose() * r - r_F_);
  out.J = pair_row(r, F.R * n_F, base_ * RelativeTurn(F.R * axis_F_, M.R * x_M_).derivative());
  return out;
}

double RackMesh::bias(const MarkerMotion& F, const MarkerMotion& M, const MarkerBias& bias_F,
                      const MarkerBias& bias_M, double /*t*/, const double* states) const {
  return (F.R * line_of_action(states)).dot(relative_bias(F, M, bias_F, bias_M)) +
         base_ * RelativeTurn(F.R * axis_F_, M.R * x_M_).bias(F, M, bias_F, bias_M);
}

void RackMesh::follow(const MarkerMotion& F, const MarkerMotion& M, double lambda, double t,
                      const double* before, double* after) const {
  const double flank = before == nullptr ? 0.0 : before[kFlank];
  const double then = before == nullptr ? t : before[kInstant];
  CountedValue now = angle(F, M, t, before);
  now.rate = RelativeTurn(F.R * axis_F_, M.R * x_M_).derivative().dot(M.w - F.w);
  follow_angle(now, "the speed of its pinion", before, then, after);
  after[kInstant] = t;
  after[kFlank] = flank_after(lambda, flank);
}

}  // namespace buckens::joints
