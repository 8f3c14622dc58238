// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/rigid_law.h"

#include <algorithm>

#include "buckens/loads/end_of_set.h"

namespace buckens::loads {

namespace {

// Of the rate; a difference of 1e-7 leaves half of the digits.
constexpr double kShift = 1e-7;

/// How fast the force of an open row falls with its rate: that of a motor at the limit of its
/// power.
/// @param row RigidLaw::row of a sight
template <class Row>
double fall(const Sight& sight, double given, Row&& row) {
  Sight faster = sight;
  faster.coordinate.rate *= 1.0 + kShift;
  const double change = faster.coordinate.rate - sight.coordinate.rate;
  return change == 0.0 ? 0.0 : std::max(0.0, (given - row(faster).given) / change);
}

}  // namespace

Action RigidLaw::evaluate(double /*t*/, const spatial::MarkerMotion& /*first*/,
                          const spatial::MarkerMotion& /*second*/) const {
  return {};
}

Action RigidLaw::respond(const Sight& sight) const {
  Action out;
  out.row = row(sight);
  // Within the step in which it lets go: closed at its start.
  const bool lets_go = sight.states != nullptr && sight.states[0] != 0.0;
  const double open = lets_go ? out.row.given + sight.stand.taken_back : out.row.given;
  const double force = out.row.is_closed ? sight.stand.force : open;
  const spatial::PairRow wrench = force * sight.coordinate.J;
  out.on_first = {wrench.segment<3>(0).transpose(), wrench.segment<3>(3).transpose()};
  out.on_second = {wrench.segment<3>(6).transpose(), wrench.segment<3>(9).transpose()};
  out.along_coordinate = force;
  out.regime = sight.stand.regime;
  if (is_source() && !out.row.is_closed) {
    const double slope = fall(sight, out.row.given, [this](const Sight& at) { return row(at); });
    if (slope > 0.0) out.regime = EndOfSet::regime(out.row.given, slope);
  }
  out.active_power = force * sight.coordinate.rate;
  if (!is_source()) out.dissipation = -out.active_power;
  return out;
}

void RigidLaw::append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const {
  SoftRow out;
  out.J = sight.coordinate.J;
  const RigidRow now = row(sight);
  out.is_rigid = now.is_closed;
  if (is_source() && !now.is_closed) {
    out.damping = fall(sight, now.given, [this](const Sight& at) { return row(at); });
  }
  rows.push_back(out);
}

void RigidLaw::find_states(const Sight& sight, double* states) const {
  states[0] = sight.stand.regime;
  const Action now = respond(sight);
  states[1] = now.row.is_closed ? now.along_coordinate : now.row.given;
}

void CoordinateLock::find_states(const Sight& sight, double* states) const {
  RigidLaw::find_states(sight, states);
  states[2] = sight.states != nullptr ? sight.states[2] : 0.0;
}

RigidRow CoordinateLock::row(const Sight& sight) const {
  RigidRow out;
  out.next = sight.stand;
  out.is_closed = sight.stand.regime != 0;
  out.holds_position = true;
  if (!out.is_closed) return out;
  out.gap = sight.coordinate.value - (sight.states != nullptr ? sight.states[2] : 0.0);
  out.slip = sight.coordinate.rate;
  return out;
}

RigidLaw::Contact RigidStop::contact(double value) const {
  const double below = value - from_;
  const double above = to_ - value;
  return below < above ? Contact{1, 1.0, below} : Contact{2, -1.0, above};
}

RigidRow RigidStop::row(const Sight& sight) const {
  RigidRow out;
  const int regime = sight.stand.regime;
  out.is_closed = regime != 0;
  out.holds_position = true;
  out.next = sight.stand;
  if (!out.is_closed) return out;
  out.gap = sight.coordinate.value - end(regime);
  out.slip = sight.coordinate.rate;
  // A stop never pulls.
  const bool pulls = regime == 1 ? sight.stand.force < 0.0 : sight.stand.force > 0.0;
  if (pulls) out.next = {};
  return out;
}

}  // namespace buckens::loads
