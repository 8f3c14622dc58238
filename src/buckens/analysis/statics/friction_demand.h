// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/analysis/statics/rest_rows.h"
#include "buckens/dynamics/mass_metric.h"
#include "buckens/model/state.h"

namespace buckens::analysis {

/// Force that frozen friction needs, compared with what it can give.
struct FrictionDemand {
  std::string load;
  double force = 0;  ///< needed [N] or [N m]
  double most = 0;   ///< available from friction [N] or [N m]
  bool is_torque = false;

  /// Above one, it would slide; HUGE_VAL if nothing presses.
  double ratio() const;
  std::string text() const;
};

/// One entry per load with frozen friction, for a contact summed over its contact points; for
/// contacts of many bodies one per pair with friction.
/// @param state at rest, with the memory that set_static_state() leaves
std::vector<FrictionDemand> friction_demands(const model::Model& model,
                                             const dynamics::MassMetric& metric,
                                             const RestRows& rest, const RestStands& stands,
                                             const model::State& state);

/// Sentences about those beyond their limit.
std::vector<std::string> overloaded_friction(const std::vector<FrictionDemand>& demands);

}  // namespace buckens::analysis
