// SPDX-License-Identifier: Apache-2.0
#include "buckens/joints/constraint_row.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace buckens::joints {

using Eigen::Vector3d;
using spatial::MarkerBias;
using spatial::MarkerMotion;

namespace {
constexpr double kWholeTurn = 2.0 * std::numbers::pi;
}  // namespace

ConstraintRow ConstraintRow::point_world(const Vector3d& e) {
  ConstraintRow row;
  row.kind_ = Kind::point_world;
  row.e_ = e;
  return row;
}

ConstraintRow ConstraintRow::point_along(const Vector3d& e_F, double offset,
                                         std::optional<base::TimeLaw> displacement) {
  ConstraintRow row;
  row.kind_ = Kind::point_along;
  row.e_ = e_F;
  row.offset_ = offset;
  row.law_ = std::move(displacement);
  return row;
}

ConstraintRow ConstraintRow::direction(const Vector3d& b_F, const Vector3d& c_M) {
  ConstraintRow row;
  row.kind_ = Kind::direction;
  row.e_ = b_F;
  row.c_ = c_M;
  return row;
}

ConstraintRow ConstraintRow::turning(const Vector3d& axis_F, const Vector3d& x_F,
                                     const Vector3d& c_M, base::TimeLaw angle) {
  ConstraintRow row;
  row.kind_ = Kind::direction;
  row.axis_ = axis_F;
  row.e_ = axis_F.cross(x_F);
  row.c_ = c_M;
  row.law_ = std::move(angle);
  return row;
}

ConstraintRow ConstraintRow::distance(double length) {
  ConstraintRow row;
  row.kind_ = Kind::distance;
  row.offset_ = length;
  return row;
}

ConstraintRow ConstraintRow::homokinetic(const Vector3d& x_F, const Vector3d& y_F,
                                         const Vector3d& x_M, const Vector3d& y_M) {
  ConstraintRow row;
  row.kind_ = Kind::homokinetic;
  row.e_ = x_F;
  row.c_ = y_M;
  row.e2_ = y_F;
  row.c2_ = x_M;
  return row;
}

ConstraintRow ConstraintRow::screw(const Vector3d& axis_F, const Vector3d& x_F, const Vector3d& x_M,
                                   double offset, double pitch) {
  ConstraintRow row;
  row.kind_ = Kind::screw;
  row.axis_ = axis_F;
  row.e_ = x_F;
  row.c_ = x_M;
  row.offset_ = offset;
  row.pitch_ = pitch;
  return row;
}

ConstraintRow ConstraintRow::by_law(std::shared_ptr<const RowLaw> law) {
  ConstraintRow row;
  row.kind_ = Kind::law;
  row.own_ = std::move(law);
  return row;
}

ConstraintRow ConstraintRow::coupled(bool is_length, std::optional<base::TimeLaw> law) {
  ConstraintRow row;
  row.kind_ = Kind::coupled;
  row.law_ = std::move(law);
  row.is_angle_ = !is_length;
  return row;
}

ConstraintRow ConstraintRow::travelling(int number, std::optional<base::TimeLaw> displacement) {
  ConstraintRow row;
  row.kind_ = Kind::travelling;
  row.number_ = number;
  row.law_ = std::move(displacement);
  return row;
}

ConstraintRow ConstraintRow::steered(double start) const {
  ConstraintRow out = *this;
  out.law_ = base::TimeLaw::constant(start);
  out.is_steered_ = true;
  return out;
}

double ConstraintRow::driven_to(double t, const double* states) const {
  Steering to;
  if (!is_steered_ || !to.read(states)) return law_ ? law_->value(t) : 0.0;
  const double ahead = t - to.t;
  return to.value + ahead * (to.rate + 0.5 * ahead * to.acceleration);
}

double ConstraintRow::driven_rate(double t, const double* states) const {
  Steering to;
  if (!is_steered_ || !to.read(states)) return law_ ? law_->rate(t) : 0.0;
  return to.rate + (t - to.t) * to.acceleration;
}

double ConstraintRow::driven_acceleration(double t, const double* states) const {
  Steering to;
  if (!is_steered_ || !to.read(states)) return law_ ? law_->acceleration(t) : 0.0;
  return to.acceleration;
}

ConstraintRow::TurningVector ConstraintRow::turning_vector(double t, const double* states,
                                                           bool with_acceleration) const {
  TurningVector b{e_, Vector3d::Zero(), Vector3d::Zero()};
  if (!law_) return b;
  const double angle = driven_to(t, states);
  const double rate = driven_rate(t, states);
  // e_ is perpendicular to the axis, so b = cos e + sin (axis × e).
  const Vector3d side = axis_.cross(e_);
  b.value = std::cos(angle) * e_ + std::sin(angle) * side;
  const Vector3d ahead = axis_.cross(b.value);
  b.rate = rate * ahead;
  if (with_acceleration) {
    b.acceleration = driven_acceleration(t, states) * ahead - rate * rate * b.value;
  }
  return b;
}

double ConstraintRow::screw_residual(const Vector3d& axis, const Vector3d& r, const MarkerMotion& F,
                                     const MarkerMotion& M) const {
  const Vector3d x = F.R * e_;
  const Vector3d moved = M.R * c_;
  const double turn = std::atan2(axis.cross(x).dot(moved), x.dot(moved)) / kWholeTurn;
  const double turns = (axis.dot(r) - offset_) / pitch_ - turn;
  return pitch_ * (turns - std::round(turns));
}

double ConstraintRow::distance_bias(const Vector3d& r, const Vector3d& r_dot,
                                    const Vector3d& a) const {
  const double length = r.norm();
  const Vector3d n = r / length;
  const double along = n.dot(r_dot);
  return n.dot(a) + (r_dot.squaredNorm() - along * along) / length;
}

RowValue ConstraintRow::evaluate(const MarkerMotion& F, const MarkerMotion& M, double t,
                                 const double* states) const {
  if (own_) return own_->evaluate(F, M, t, states);
  RowValue out;
  const Vector3d r = M.p - F.p;
  switch (kind_) {
    case Kind::point_world:
      out.g = e_.dot(r);
      out.J.segment<3>(3) = -e_.transpose();
      out.J.segment<3>(9) = e_.transpose();
      break;
    case Kind::point_along: {
      const Vector3d e = F.R * e_;
      out.g = e.dot(r) - offset_ - driven_to(t, states);
      out.g_t = -driven_rate(t, states);
      out.J.segment<3>(0) = e.cross(r).transpose();
      out.J.segment<3>(3) = -e.transpose();
      out.J.segment<3>(9) = e.transpose();
      break;
    }
    case Kind::direction: {
      const TurningVector b_F = turning_vector(t, states, false);
      const Vector3d b = F.R * b_F.value;
      const Vector3d c = M.R * c_;
      out.g = b.dot(c);
      out.g_t = (F.R * b_F.rate).dot(c);
      const Vector3d b_x_c = b.cross(c);
      out.J.segment<3>(0) = b_x_c.transpose();
      out.J.segment<3>(6) = -b_x_c.transpose();
      break;
    }
    default:
      evaluate_coupling(F, M, r, out);
  }
  return out;
}

void ConstraintRow::evaluate_coupling(const MarkerMotion& F, const MarkerMotion& M,
                                      const Vector3d& r, RowValue& out) const {
  switch (kind_) {
    case Kind::distance: {
      const double length = r.norm();
      out.g = length - offset_;
      // Two coincident points have no direction; assembly then proceeds differently.
      const Vector3d n = length > 0.0 ? Vector3d(r / length) : Vector3d::UnitX();
      out.J.segment<3>(3) = -n.transpose();
      out.J.segment<3>(9) = n.transpose();
      break;
    }
    case Kind::homokinetic: {
      const Vector3d x = F.R * e_, y = F.R * e2_, y_M = M.R * c_, x_M = M.R * c2_;
      out.g = x.dot(y_M) - y.dot(x_M);
      const Vector3d arm = x.cross(y_M) - y.cross(x_M);
      out.J.segment<3>(0) = arm.transpose();
      out.J.segment<3>(6) = -arm.transpose();
      break;
    }
    case Kind::screw: {
      const Vector3d axis = F.R * axis_;
      out.g = screw_residual(axis, r, F, M);
      out.J.segment<3>(0) = (axis.cross(r) + pitch_ / kWholeTurn * axis).transpose();
      out.J.segment<3>(3) = -axis.transpose();
      out.J.segment<3>(6) = -pitch_ / kWholeTurn * axis.transpose();
      out.J.segment<3>(9) = axis.transpose();
      break;
    }
    default:
      break;
  }
}

double ConstraintRow::bias(const MarkerMotion& F, const MarkerMotion& M, const MarkerBias& bias_F,
                           const MarkerBias& bias_M, double t, const double* states) const {
  if (own_) return own_->bias(F, M, bias_F, bias_M, t, states);
  const Vector3d r = M.p - F.p;
  const Vector3d r_dot = M.v - F.v;
  const Vector3d a = bias_M.a - bias_F.a;
  if (kind_ == Kind::point_world) return e_.dot(a);
  if (kind_ == Kind::distance) return distance_bias(r, r_dot, a);
  if (kind_ == Kind::point_along || kind_ == Kind::screw) {
    const Vector3d e = F.R * (kind_ == Kind::screw ? axis_ : e_);
    const Vector3d e_dot = F.w.cross(e);
    const Vector3d e_bias = bias_F.alpha.cross(e) + F.w.cross(e_dot);
    const double slide = e_bias.dot(r) + 2.0 * e_dot.dot(r_dot) + e.dot(a);
    if (kind_ == Kind::point_along) return slide - driven_acceleration(t, states);
    const double turn = e.dot(bias_M.alpha - bias_F.alpha) + e_dot.dot(M.w - F.w);
    return slide - pitch_ / kWholeTurn * turn;
  }
  // The rate of a product of two directions b·c, twice.
  const auto product = [&](const Vector3d& b, const Vector3d& c) {
    const Vector3d b_dot = F.w.cross(b);
    const Vector3d c_dot = M.w.cross(c);
    return (bias_F.alpha.cross(b) + F.w.cross(b_dot)).dot(c) + 2.0 * b_dot.dot(c_dot) +
           b.dot(bias_M.alpha.cross(c) + M.w.cross(c_dot));
  };
  if (kind_ == Kind::homokinetic) {
    return product(F.R * e_, M.R * c_) - product(F.R * e2_, M.R * c2_);
  }
  const TurningVector b_F = turning_vector(t, states, true);
  const Vector3d b = F.R * b_F.value;
  const Vector3d rel = F.R * b_F.rate;
  const Vector3d c = M.R * c_;
  const Vector3d b_dot = F.w.cross(b) + rel;
  const Vector3d c_dot = M.w.cross(c);
  const Vector3d b_bias = bias_F.alpha.cross(b) + F.w.cross(F.w.cross(b)) + 2.0 * F.w.cross(rel) +
                          F.R * b_F.acceleration;
  const Vector3d c_bias = bias_M.alpha.cross(c) + M.w.cross(c_dot);
  return b_bias.dot(c) + 2.0 * b_dot.dot(c_dot) + b.dot(c_bias);
}

}  // namespace buckens::joints
