// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/distributed_load.h"

#include <algorithm>
#include <utility>

namespace buckens::loads {

DistributedLoad::DistributedLoad(LoadAxes axes, std::array<base::TimeLaw, 3> value, double extent)
    : axes_(axes), value_(std::move(value)), extent_(extent) {}

Action DistributedLoad::evaluate(double t, const spatial::MarkerMotion& first,
                                 const spatial::MarkerMotion& /*second*/) const {
  Eigen::Vector3d force = extent_ * values(t);
  if (axes_ == LoadAxes::following) force = first.R * force;
  Action action;
  action.on_first.force = force;
  action.active_power = force.dot(first.v);
  return action;
}

bool DistributedLoad::is_constant() const {
  return std::all_of(value_.begin(), value_.end(),
                     [](const base::TimeLaw& law) { return law.is_constant(); });
}

}  // namespace buckens::loads
