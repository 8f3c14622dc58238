// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/distributed_load.h"

#include <algorithm>
#include <utility>

namespace buckens::loads {

DistributedLoad::DistributedLoad(LoadAxes axes, std::array<base::TimeLaw, 3> value, double extent,
                                 SignalFactor factor)
    : axes_(axes), value_(std::move(value)), extent_(extent), factor_(factor) {}

Action DistributedLoad::evaluate(double t, const spatial::MarkerMotion& first,
                                 const spatial::MarkerMotion& /*second*/) const {
  return push(values(t), first);
}

Action DistributedLoad::respond(const Sight& sight) const {
  return push(factor_.value(sight) * values(sight.t), sight.first);
}

Action DistributedLoad::push(const Eigen::Vector3d& value,
                             const spatial::MarkerMotion& first) const {
  Eigen::Vector3d force = extent_ * value;
  if (axes_ == LoadAxes::following) force = first.R * force;
  Action action;
  action.on_first.force = force;
  action.active_power = force.dot(first.v);
  return action;
}

bool DistributedLoad::is_constant() const {
  return !factor_.exists() && std::all_of(value_.begin(), value_.end(),
                                          [](const auto& law) { return law.is_constant(); });
}

}  // namespace buckens::loads
