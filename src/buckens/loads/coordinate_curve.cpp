// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/coordinate_curve.h"

#include <algorithm>

namespace buckens::loads {

Action CoordinateCurve::evaluate(double /*t*/, const spatial::MarkerMotion& /*first*/,
                                 const spatial::MarkerMotion& /*second*/) const {
  return {};
}

Action CoordinateCurve::respond(const Sight& sight) const {
  const auto [stiffness, damping, free] = laws_.at(sight.t, sight.signals);
  const double x = sight.coordinate.value - free;
  const double v = sight.coordinate.rate;
  const double at_rest = curve_.force(x, 0.0);
  const double lost = damping * v + curve_.force(x, v) - at_rest;
  Action out = along_coordinate(sight.coordinate, -stiffness * x - at_rest - lost);
  out.stored_energy = 0.5 * stiffness * x * x + curve_.energy(x);
  out.dissipation = lost * v;
  out.active_power = -out.dissipation;
  return out;
}

void CoordinateCurve::append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const {
  const auto [stiffness, damping, free] = laws_.at(sight.t, sight.signals);
  const base::Characteristic::Slopes slopes =
      curve_.slopes(sight.coordinate.value - free, sight.coordinate.rate);
  SoftRow row;
  row.J = sight.coordinate.J;
  // Where the force falls, the iteration goes without: it converges by the inertia then.
  row.stiffness = std::max(0.0, stiffness + slopes.stiffness);
  row.damping = std::max(0.0, damping + slopes.damping);
  rows.push_back(row);
}

}  // namespace buckens::loads
