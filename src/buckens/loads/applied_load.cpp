// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/applied_load.h"

#include <algorithm>
#include <utility>

namespace buckens::loads {

AppliedLoad::AppliedLoad(Kind kind, LoadAxes axes, std::array<base::TimeLaw, 3> value,
                         SignalFactor factor)
    : kind_(kind), axes_(axes), value_(std::move(value)), factor_(factor) {}

Action AppliedLoad::evaluate(double t, const spatial::MarkerMotion& first,
                             const spatial::MarkerMotion& /*second*/) const {
  return act(values(t), first);
}

Action AppliedLoad::respond(const Sight& sight) const {
  return act(factor_.value(sight) * values(sight.t), sight.first);
}

Action AppliedLoad::act(const Eigen::Vector3d& values, const spatial::MarkerMotion& first) const {
  Eigen::Vector3d load = values;
  if (axes_ == LoadAxes::following) load = first.R * load;
  Action action;
  if (kind_ == Kind::force) {
    action.on_first.force = load;
    action.active_power = load.dot(first.v);
  } else {
    action.on_first.torque = load;
    action.active_power = load.dot(first.w);
  }
  return action;
}

bool AppliedLoad::is_constant() const {
  return !factor_.exists() && std::all_of(value_.begin(), value_.end(),
                                          [](const auto& law) { return law.is_constant(); });
}

}  // namespace buckens::loads
