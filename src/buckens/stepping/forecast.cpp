// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/forecast.h"

#include <array>

namespace buckens::stepping {

namespace {

constexpr int kSteps = 3;  // that a parabola needs
// Instants close together do not foretell those far ahead; they occur after a change of step.
constexpr double kLeastSpacing = 0.2;  // relative to the distance that is foretold
// The straight line through two steps must miss the third by this much less than the second step
// itself does; else the parabola is not likely to come closer.
constexpr double kForetold = 0.5;

Vector6 acceleration_of(const model::BodyState& s) {
  Vector6 out;
  out << s.w_dot, s.v_dot;
  return out;
}

Eigen::Map<const Vector6> acceleration_of(const model::PastStep& past, std::size_t body) {
  return Eigen::Map<const Vector6>(past.accelerations.data() + 6 * body);
}

double squared_size(const Vector6& acceleration, double L) {
  return L * L * acceleration.head<3>().squaredNorm() + acceleration.tail<3>().squaredNorm();
}

}  // namespace

bool Forecast::foretells(const model::State& state) const {
  // Accelerations of Wilson's method are not those at which its equations hold.
  if (state.history < kSteps || scheme_.has_offset()) return false;
  const auto size = static_cast<Eigen::Index>(6 * state.bodies.size());
  for (const model::PastStep* past : {&state.before, &state.earlier}) {
    if (past->accelerations.size() != size || past->lambda.size() != state.lambda.size()) {
      return false;
    }
  }
  const double last = state.lambda_time - state.before.t;
  const double before = state.before.t - state.earlier.t;
  const double ahead = scheme_.evaluation_time(state.t) - state.lambda_time;
  if (!(last >= kLeastSpacing * ahead && before >= kLeastSpacing * ahead)) return false;
  double missed_by_line = 0;
  double missed_by_last = 0;
  for (std::size_t b = 0; b < state.bodies.size(); ++b) {
    const Vector6 now = acceleration_of(state.bodies[b]);
    const Vector6 change = now - acceleration_of(state.before, b);
    const Vector6 change_before =
        acceleration_of(state.before, b) - acceleration_of(state.earlier, b);
    missed_by_last += squared_size(change, L_);
    missed_by_line += squared_size(change - (last / before) * change_before, L_);
  }
  return missed_by_line <= kForetold * kForetold * missed_by_last;
}

Forecast::Parabola Forecast::parabola(const model::State& state) const {
  const double t = scheme_.evaluation_time(state.t);
  const std::array<double, 3> at = {state.lambda_time, state.before.t, state.earlier.t};
  Parabola weights = {1.0, 1.0, 1.0};
  for (std::size_t k = 0; k < at.size(); ++k) {
    for (std::size_t j = 0; j < at.size(); ++j) {
      if (j != k) weights[k] *= (t - at[j]) / (at[k] - at[j]);
    }
  }
  return weights;
}

Vector6 Forecast::acceleration(const model::State& state, const Parabola& weights,
                               std::size_t body) {
  return weights[0] * acceleration_of(state.bodies[body]) +
         weights[1] * acceleration_of(state.before, body) +
         weights[2] * acceleration_of(state.earlier, body);
}

void Forecast::foretell_multipliers(const model::State& state, const Parabola& weights,
                                    linalg::Vector& lambda) {
  lambda = weights[0] * state.lambda + weights[1] * state.before.lambda +
           weights[2] * state.earlier.lambda;
}

void Forecast::apply(const model::State& state, std::vector<BodyStep>& bodies,
                     linalg::Vector& lambda) const {
  const Parabola weights = parabola(state);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    bodies[b].u = (acceleration(state, weights, b) - bodies[b].frame.acceleration) /
                  scheme_.acceleration_rate;
  }
  foretell_multipliers(state, weights, lambda);
}

void note_past(const model::State& before, model::State& end) {
  end.earlier = before.before;
  end.before.t = before.lambda_time;
  end.before.lambda = before.lambda;
  end.before.accelerations.resize(static_cast<Eigen::Index>(6 * before.bodies.size()));
  for (std::size_t b = 0; b < before.bodies.size(); ++b) {
    end.before.accelerations.segment<6>(static_cast<Eigen::Index>(6 * b)) =
        acceleration_of(before.bodies[b]);
  }
}

}  // namespace buckens::stepping
