// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/bristle_friction.h"

#include <algorithm>
#include <cmath>

namespace buckens::loads {

BristleFriction::Bend BristleFriction::bend(const Sight& sight) const {
  const double rate = sight.coordinate.rate;
  Bend out;
  const FrictionBound most = bound_.at(sight);
  out.bound = most.at(most.load(sight), rate);
  const double before = sight.states != nullptr ? sight.states[0] : 0.0;
  const double bound_before = sight.states != nullptr ? sight.states[1] : 0.0;
  // Over the way f_s goes from the one at the start of the step to that at its end.
  const double to = out.bound / bristles_.stiffness;
  const double from = bound_before > 0.0 ? bound_before / bristles_.stiffness : to;
  const double way = std::abs(sight.coordinate.change);
  const double sign = sight.coordinate.change < 0.0 ? -1.0 : 1.0;
  out.z =
      to > 0.0 ? sign * bent_over(way, sign * before, {from, to}, bristles_.elastic_share) : 0.0;
  const double ahead = rate < 0.0 ? -out.z : out.z;
  out.slope = to > 0.0 ? slope_of_bristles(ahead, to, bristles_.elastic_share) : 0.0;
  return out;
}

Action BristleFriction::evaluate(double /*t*/, const spatial::MarkerMotion& /*first*/,
                                 const spatial::MarkerMotion& /*second*/) const {
  return {};
}

double BristleFriction::force(const Sight& sight, const Bend& now) const {
  const double rate = sight.coordinate.rate;
  return -bristles_.stiffness * now.z - bristles_.damping * rate * now.slope -
         bound_.at(sight).data().viscous * rate;
}

Action BristleFriction::respond(const Sight& sight) const {
  const Bend now = bend(sight);
  const double rate = sight.coordinate.rate;
  const double bent_rate = rate * now.slope;
  const double elastic = bristles_.stiffness * now.z;
  const double force = this->force(sight, now);
  Action out = along_coordinate(sight.coordinate, force);
  out.stored_energy = 0.5 * elastic * now.z;
  out.active_power = force * rate + elastic * bent_rate;
  out.dissipation = -out.active_power;
  // Bristles bend over steps or within one: their tangent is formed again as their slope falls.
  const int bent = now.slope > kHardlyBent ? 0 : now.slope > 0.5 * kHardlyBent ? 1 : 2;
  out.regime = rate < 0.0 ? -bent : bent;
  return out;
}

void BristleFriction::append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const {
  const double slope = std::max(0.0, bend(sight).slope);
  SoftRow row;
  row.J = sight.coordinate.J;
  row.stiffness = slope * bristles_.stiffness;
  row.damping = slope * bristles_.damping + bound_.at(sight).data().viscous;
  rows.push_back(row);
}

void BristleFriction::append_slopes(const Sight& sight, int /*regime*/,
                                    std::vector<spatial::Wrench>& out) const {
  // Across a whole step z has no simple derivative: a difference. The load grows with the reaction.
  const FrictionBound bound = bound_.at(sight);
  const double load = bound.load(sight);
  const auto with = [&](double factor) {
    Sight other = sight;
    other.reaction.force *= factor;
    other.reaction.torque *= factor;
    return force(other, bend(other));
  };
  const double growth =
      load > 0.0 ? (with(1.0 + kHeavier) - with(1.0 - kHeavier)) / (2.0 * kHeavier * load) : 0.0;
  out.push_back(bound.load_slope(sight, growth));
}

void BristleFriction::find_states(const Sight& sight, double* states) const {
  const Bend now = bend(sight);
  states[0] = now.z;
  states[1] = now.bound;
}

}  // namespace buckens::loads
