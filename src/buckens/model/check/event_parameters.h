// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "buckens/model/check/finding.h"
#include "buckens/model/spec/model_description.h"

namespace buckens::model {

/// Settings that gravity follows where events change it, one per component.
inline constexpr std::array<const char*, 3> kGravitySettings = {"gravity.0", "gravity.1",
                                                                "gravity.2"};

/// Whether an event changes gravity, all of it.
inline bool names_gravity(const SettingChange& change) {
  return change.name == "gravity" && change.vector;
}

/// Whether an event changes a parameter, "loads.damper.damping", or gravity, and not a signal.
inline bool names_parameter(const SettingChange& change) {
  return change.name.find('.') != std::string::npos || names_gravity(change);
}

/// What is wrong with a change of a parameter; the field path is below the event.
Found parameter_problem(const SettingChange& change, const ModelDescription& model);

/// Makes a setting of every parameter that events change, which the parameter then follows. The
/// signals have the names of the parameters.
/// @pre parameter_problem() finds nothing
void make_settings_of_parameters(ModelDescription& model);

}  // namespace buckens::model
