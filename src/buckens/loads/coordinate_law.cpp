// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/coordinate_law.h"

#include <algorithm>

#include "buckens/loads/end_of_set.h"

namespace buckens::loads {

namespace {

/// A force after its projection.
struct Projected {
  double bounded = 0;  // of spring and damper
  double whole = 0;    // with the outer damper
  double strain = 0;   // after rest has followed
  bool is_cut = false;
  bool has_broken = false;  // the spring of a yielding law was strained beyond what its set admits
  int damper_limit = 0;     // 1: the damper pushes with the force of the spring, −1: against it
};

Projected project(const ProjectedForce& law, double rate) {
  Projected out;
  out.whole = -law.outer_damping * rate;
  out.strain = law.is_on ? law.strain : 0.0;
  if (!law.is_on) return out;
  const double elastic = law.stiffness * law.strain;
  double viscous = law.damping * rate;
  if (law.is_damper_limited && std::abs(viscous) > std::abs(elastic)) {
    out.damper_limit = (viscous > 0.0) == (elastic > 0.0) ? 1 : -1;
    viscous = out.damper_limit * elastic;
  }
  const double trial = law.drive - elastic - viscous;
  // The set contains zero, so its ends are in order for any bound.
  out.bounded = std::clamp(trial, std::min(law.lowest, 0.0), std::max(law.highest, 0.0));
  out.is_cut = out.bounded != trial;
  out.whole += out.bounded;
  if (out.is_cut && law.is_yielding) {
    out.strain = law.stiffness > 0.0 ? -out.bounded / law.stiffness : 0.0;
  } else if (law.is_yielding && law.stiffness > 0.0) {
    // A coordinate that has turned round within a long step has a damper that makes up for any
    // strain. The spring has broken away all the same.
    out.strain = std::clamp(law.strain, -std::max(law.highest, 0.0) / law.stiffness,
                            -std::min(law.lowest, 0.0) / law.stiffness);
    out.has_broken = out.strain != law.strain;
  }
  return out;
}

int regime_of(const ProjectedForce& law, const Projected& force) {
  if (!law.is_on) return 2;
  if (!force.is_cut) return 10 * force.damper_limit;
  return EndOfSet::regime(force.bounded, law.cut_damping);
}

}  // namespace

Action along_coordinate(const CoordinateMotion& coordinate, double force) {
  const spatial::PairRow wrench = force * coordinate.J;
  Action out;
  out.on_first = {wrench.segment<3>(0).transpose(), wrench.segment<3>(3).transpose()};
  out.on_second = {wrench.segment<3>(6).transpose(), wrench.segment<3>(9).transpose()};
  out.along_coordinate = force;
  return out;
}

Action CoordinateLaw::evaluate(double /*t*/, const spatial::MarkerMotion& /*first*/,
                               const spatial::MarkerMotion& /*second*/) const {
  return {};
}

Action CoordinateLaw::respond(const Sight& sight) const {
  const CoordinateResponse response = answer(sight);
  Action out = along_coordinate(sight.coordinate, response.force);
  out.stored_energy = response.stored_energy;
  out.active_power = response.active_power;
  out.dissipation = response.dissipation;
  out.regime = response.regime;
  return out;
}

CoordinateResponse CoordinateLaw::answer(const Sight& sight) const {
  const ProjectedForce law = force(sight);
  const double rate = sight.coordinate.rate;
  const Projected f = project(law, rate);
  CoordinateResponse out;
  out.force = f.whole;
  out.strain = f.strain;
  out.regime = regime_of(law, f);
  if (law.is_source) {
    out.active_power = f.whole * rate;
    return out;
  }
  // If rest follows, the spring stays as strained as it is: all power is dissipated.
  const bool is_straining = law.is_on && !f.has_broken && !(f.is_cut && law.is_yielding);
  out.stored_energy = 0.5 * law.stiffness * f.strain * f.strain;
  const double stored_rate = is_straining ? law.stiffness * f.strain * rate : 0.0;
  out.active_power = f.whole * rate + stored_rate;
  out.dissipation = -out.active_power;
  return out;
}

void CoordinateLaw::append_tangent(const Sight& sight, std::vector<SoftRow>& rows) const {
  append_tangent_in_regime(sight, rows);
}

int CoordinateLaw::append_tangent_in_regime(const Sight& sight, std::vector<SoftRow>& rows) const {
  const ProjectedForce law = force(sight);
  const Projected f = project(law, sight.coordinate.rate);
  const bool is_elastic = law.is_on && !f.is_cut;
  const bool is_limited = f.damper_limit != 0;
  SoftRow row;
  row.J = sight.coordinate.J;
  row.stiffness = is_elastic ? (1 + f.damper_limit) * law.stiffness : 0.0;
  row.damping = law.outer_damping + (is_elastic && !is_limited ? law.damping : 0.0) +
                (f.is_cut ? law.cut_damping : 0.0);
  rows.push_back(row);
  return regime_of(law, f);
}

UnlimitedForce CoordinateLaw::unlimited(const Sight& sight) const {
  const ProjectedForce law = force(sight);
  UnlimitedForce out;
  if (!law.is_on || law.is_damper_limited) return out;
  const double rate = sight.coordinate.rate;
  out.excess =
      law.drive - law.stiffness * law.strain - law.damping * rate - project(law, rate).bounded;
  out.stiffness = law.stiffness;
  out.damping = law.damping + law.outer_damping;
  return out;
}

void CoordinateLaw::find_states(const Sight& sight, double* states) const {
  if (is_yielding()) states[0] = answer(sight).strain;
}

ProjectedForce CoordinateSpring::force(const Sight& sight) const {
  const SpringNumbers now = laws_.at(sight.t, sight.signals);
  ProjectedForce out;
  out.strain = sight.coordinate.value - now.free;
  out.stiffness = now.stiffness;
  out.damping = now.damping;
  return out;
}

ProjectedForce CoordinateStop::force(const Sight& sight) const {
  ProjectedForce out;
  const double value = sight.coordinate.value;
  const bool is_above = value > to_;
  out.is_on = is_above || value < from_;
  if (!out.is_on) return out;
  out.strain = value - (is_above ? to_ : from_);
  out.stiffness = stiffness_;
  out.damping = damping_;
  out.is_damper_limited = true;
  (is_above ? out.highest : out.lowest) = 0.0;
  return out;
}

}  // namespace buckens::loads
