// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>
#include <string_view>

namespace buckens::spatial {

inline constexpr double kTurn = 2.0 * std::numbers::pi;  ///< [rad]

/// A coordinate with whole turns stored separately, so that many turns do not cost digits.
struct CountedValue {
  int turns = 0;        ///< of an angle; 0 of a displacement
  double fraction = 0;  ///< angle within the turn, −π … π [rad], or displacement [m]
  double rate = 0;      ///< where turns are counted [rad/s] or [m/s]
  double t = 0;         ///< the instant to which it belongs [s]

  /// The whole angle [rad] or displacement [m].
  double value() const { return kTurn * turns + fraction; }
};

/// Where a coordinate would be at t if it went on at its rate: its fraction may leave the turn.
inline CountedValue expected_at(const CountedValue& before, double t) {
  return {before.turns, before.fraction + before.rate * (t - before.t), before.rate, t};
}

/// How many turns an angle has left the one where it was. Beyond what is counted the motion has
/// diverged, and none.
/// @param jump of its fraction from where it was expected to where it is [rad]
int turns_of(double jump);

/// The counted angle that is nearest to the one expected, whose rate it keeps.
/// @param fraction within the turn, −π … π [rad]
inline CountedValue follow_turns(const CountedValue& expected, double fraction) {
  const double jump = expected.fraction - fraction;
  const int turns = std::abs(jump) > 0.5 * kTurn ? turns_of(jump) : 0;  // few leave their turn
  return {expected.turns + turns, fraction, expected.rate, expected.t};
}

/// Whether turns can be counted from one instant to another: the rate changes by so little that one
/// turn more or less cannot be meant.
/// @param turn after which it repeats [rad] or [m]
inline bool is_countable(const CountedValue& before, const CountedValue& after, double turn) {
  // Between two rates the way differs at most by so much from that of the first.
  return std::abs(after.rate - before.rate) * (after.t - before.t) <= 0.5 * turn;
}
/// @param what names it @throws StepTooLong if it is not
void require_countable(const CountedValue& before, const CountedValue& after, double turn,
                       std::string_view what);

/// How far an angle within the turn has turned: the way that is nearest to the one expected [rad].
inline double way_turned(double from, double to, double expected) {
  return expected + std::remainder(to - from - expected, kTurn);
}

/// Difference between two values of a coordinate, with all digits.
inline double difference(const CountedValue& from, const CountedValue& to) {
  return kTurn * (to.turns - from.turns) + (to.fraction - from.fraction);
}

}  // namespace buckens::spatial
