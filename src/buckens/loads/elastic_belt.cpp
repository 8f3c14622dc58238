// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/elastic_belt.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/spatial/counted_value.h"

namespace buckens::loads {

using Eigen::Vector3d;

namespace {

// A strain that yielded in the step before stands at its bound but for rounding.
constexpr double kAtBound = 1.0 - 1e-9;
constexpr int kFirstAngle = 0, kSecondAngle = 1, kWound = 2, kBeltSlip = 3;
constexpr int kFirstRate = 4, kSecondRate = 5, kInstant = 6;

double angle_about(const Vector3d& axis, const Vector3d& from, const Vector3d& to) {
  return std::atan2(axis.dot(from.cross(to)), from.dot(to));
}

}  // namespace

struct ElasticBelt::Stand {
  spatial::PairRow apart, winding;  // rates of the spans' common and opposite elongation
  double apart_rate = 0, winding_rate = 0;
  double first_angle = 0, second_angle = 0;
  double first_rate = 0, second_rate = 0;  // of them
  double stretch = 0;          // T₀ + k (L − L₀), the mean tension without slack [N]
  double wound = 0;            // x, after it has yielded [m]
  double slipped = 0;          // within the step [m]
  double left = 0, right = 0;  // tensions [N]
  double left_elastic = 0, right_elastic = 0;  // their shares that are stored [N]
  double share = 1;                            // most that their difference can be of their sum
  double share_rate = 0;  // by wraps that grow or shrink as the centres move [1/s]
  int regime = 0;         // 0 sticks; ±1 slips; 2, 3: the right, the left span is slack; 4: both

  /// By the common and opposite elongation of the spans.
  void find_tensions(const ElasticBeltData& data);
  /// Rate of `wound` [m/s]: where it yields, that of the bound.
  double wound_rate(const ElasticBeltData& data) const;
};

double ElasticBelt::way(double distance, double first_radius, double second_radius) {
  const double difference = first_radius - second_radius;
  const double span = std::sqrt(distance * distance - difference * difference);
  return span + difference * std::asin(difference / distance);
}

void ElasticBelt::Stand::find_tensions(const ElasticBeltData& data) {
  const double k = data.stiffness, c = data.damping;
  const double x = wound;
  if (data.coefficient) {
    const double sum = 2.0 * std::max(0.0, stretch + c * apart_rate);
    const double trial = 2.0 * (k * x + c * winding_rate);
    const double bound = share * sum;
    const double difference = std::clamp(trial, -bound, bound);
    // Where damping alone exceeds the bound, nothing is stretched.
    const double most = share * std::max(0.0, stretch) / k;
    wound = std::clamp(x, -most, most);
    slipped = x - wound;
    if (difference != trial) regime = trial > 0.0 ? 1 : -1;
    left = 0.5 * (sum + difference);
    right = 0.5 * (sum - difference);
  } else {
    left = std::max(0.0, stretch + k * x + c * (apart_rate + winding_rate));
    right = std::max(0.0, stretch - k * x + c * (apart_rate - winding_rate));
    if (left == 0.0) regime = 3;
    if (right == 0.0) regime = 2;
  }
  if (left == 0.0 && right == 0.0) regime = 4;
  left_elastic = std::max(0.0, stretch + k * wound);
  right_elastic = std::max(0.0, stretch - k * wound);
}

double ElasticBelt::Stand::wound_rate(const ElasticBeltData& data) const {
  if (!data.coefficient) return winding_rate;
  if (stretch <= 0.0) return 0.0;
  const double most = share * stretch / data.stiffness;
  if (std::abs(wound) < kAtBound * most) return winding_rate;
  const double side = wound > 0.0 ? 1.0 : -1.0;
  const double bound_rate = share * apart_rate + share_rate * stretch / data.stiffness;
  return side * std::min(side * winding_rate, bound_rate);
}

ElasticBelt::Stand ElasticBelt::look(const Sight& sight) const {
  const double r1 = data_.first_radius, r2 = data_.second_radius;
  const Vector3d axis = sight.first.R * data_.axis_F;
  Vector3d line = sight.second.p - sight.first.p;
  line -= axis * axis.dot(line);
  const double D = line.norm();
  if (!(D > std::abs(r1 - r2))) {
    throw NumericalError(
        fmt::format("its pulleys of {:g} m and {:g} m have come within {:.6g} m of each other; "
                    "look at what holds their centres",
                    r1, std::abs(r2), D));
  }
  const Vector3d e = line / D;
  const Vector3d n = axis.cross(e);
  const double sine = (r1 - r2) / D;
  const double cosine = std::sqrt(1.0 - sine * sine);
  Stand out;
  out.apart << 0, 0, 0, (-cosine * e).transpose(), 0, 0, 0, (cosine * e).transpose();
  out.winding << (r1 * axis).transpose(), (sine * n).transpose(), (-r2 * axis).transpose(),
      (-sine * n).transpose();
  Eigen::Matrix<double, 12, 1> V;
  V << sight.first.w, sight.first.v, sight.second.w, sight.second.v;
  out.apart_rate = out.apart.dot(V);
  out.winding_rate = out.winding.dot(V);
  out.first_angle = angle_about(axis, e, sight.first.R * data_.x_F);
  out.second_angle = angle_about(axis, e, sight.second.R * data_.x_M);
  const double turn = n.dot(sight.second.v - sight.first.v) / D;  // of the line of centres
  out.first_rate = axis.dot(sight.first.w) - turn;
  out.second_rate = axis.dot(sight.second.w) - turn;
  out.stretch = data_.pretension + data_.stiffness * (way(D, r1, r2) - data_.way);
  // At rest it is as far as its pulleys have turned since it was placed.
  const std::array<double, kStates> placed = {data_.placed_angle, data_.placed_angle};
  const double* const before = sight.states != nullptr ? sight.states : placed.data();
  const double since = sight.states != nullptr ? sight.t - before[kInstant] : 0.0;
  out.wound =
      before[kWound] +
      r1 * spatial::way_turned(before[kFirstAngle], out.first_angle, since * before[kFirstRate]) -
      r2 * spatial::way_turned(before[kSecondAngle], out.second_angle, since * before[kSecondRate]);
  if (data_.coefficient) {
    // An open belt wraps π + 2γ and π − 2γ, a crossed one π + 2γ twice.
    const double gamma = std::asin(sine);
    const double wrap = std::numbers::pi + 2.0 * (r2 < 0.0 ? gamma : -std::abs(gamma));
    out.share = std::tanh(0.5 * *data_.coefficient * wrap);  // (m − 1)/(m + 1)
    const double gamma_rate = -sine / (D * cosine * cosine) * out.apart_rate;
    const double wrap_rate = 2.0 * (r2 < 0.0 || gamma < 0.0 ? gamma_rate : -gamma_rate);
    out.share_rate = (1.0 - out.share * out.share) * 0.5 * *data_.coefficient * wrap_rate;
  }
  out.find_tensions(data_);
  return out;
}

Action ElasticBelt::evaluate(double /*t*/, const spatial::MarkerMotion& /*first*/,
                             const spatial::MarkerMotion& /*second*/) const {
  return {};
}

Action ElasticBelt::respond(const Sight& sight) const {
  const Stand s = look(sight);
  const spatial::PairRow wrench = -(s.left + s.right) * s.apart - (s.left - s.right) * s.winding;
  Action out;
  out.on_first = {wrench.segment<3>(0).transpose(), wrench.segment<3>(3).transpose()};
  out.on_second = {wrench.segment<3>(6).transpose(), wrench.segment<3>(9).transpose()};
  const double k = data_.stiffness;
  // Beyond what is stored as placed.
  out.stored_energy = 0.5 *
                      (s.left_elastic * s.left_elastic + s.right_elastic * s.right_elastic -
                       2.0 * data_.pretension * data_.pretension) /
                      k;
  const double wound_rate = s.wound_rate(data_);
  const double stored_rate =
      s.left_elastic * (s.apart_rate + wound_rate) + s.right_elastic * (s.apart_rate - wound_rate);
  out.active_power =
      -(s.left + s.right) * s.apart_rate - (s.left - s.right) * s.winding_rate + stored_rate;
  out.dissipation = -out.active_power;
  out.regime = s.regime;
  return out;
}

void ElasticBelt::append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const {
  const Stand s = look(sight);
  SoftRow apart, winding;
  apart.J = s.apart;
  winding.J = s.winding;
  const bool is_one_slack = s.regime == 2 || s.regime == 3;
  if (is_one_slack) apart.J += (s.regime == 2 ? 1.0 : -1.0) * s.winding;
  const double spans = s.regime == 4 ? 0.0 : is_one_slack ? 1.0 : 2.0;
  apart.stiffness = spans * data_.stiffness;
  apart.damping = spans * data_.damping;
  const double sticks = s.regime == 0 ? 2.0 : 0.0;
  winding.stiffness = sticks * data_.stiffness;
  winding.damping = sticks * data_.damping;
  rows.push_back(apart);
  rows.push_back(winding);
}

void ElasticBelt::start_states(const Sight& sight, double* states) const {
  // Put on where the pulleys stand.
  Sight fresh = sight;
  fresh.states = nullptr;
  find_states(fresh, states);
  states[kWound] = states[kBeltSlip] = 0.0;
}

void ElasticBelt::find_states(const Sight& sight, double* states) const {
  const Stand s = look(sight);
  states[kFirstAngle] = s.first_angle;
  states[kSecondAngle] = s.second_angle;
  if (sight.states != nullptr) {
    const double then = sight.states[kInstant];
    spatial::require_countable({0, 0, sight.states[kFirstRate], then},
                               {0, 0, s.first_rate, sight.t}, spatial::kTurn,
                               "the speed of its first pulley");
    spatial::require_countable({0, 0, sight.states[kSecondRate], then},
                               {0, 0, s.second_rate, sight.t}, spatial::kTurn,
                               "the speed of its second pulley");
  }
  states[kFirstRate] = s.first_rate;
  states[kSecondRate] = s.second_rate;
  states[kInstant] = sight.t;
  states[kWound] = s.wound;
  states[kBeltSlip] = s.slipped + (sight.states != nullptr ? sight.states[kBeltSlip] : 0.0);
}

BeltReading ElasticBelt::read(const Sight& sight) const {
  const Stand s = look(sight);
  const double before = sight.states != nullptr ? sight.states[kBeltSlip] : 0.0;
  return {s.left, s.right, before + s.slipped};
}

}  // namespace buckens::loads
