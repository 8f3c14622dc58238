// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/loads/elastic_gear_spec.h"
#include "buckens/model/build/marker_finder.h"

namespace buckens::model {

/// Gives a load of the model under construction the markers and the force law of two gears with
/// elastic teeth.
/// @param load with its name
/// @throws InputError, ModelError naming the load and its place in the file
void set_gear_teeth(const loads::ElasticGearSpec& spec, MarkerFinder& find, Load& load,
                    const SourceLocation& where);

/// @throws ModelError naming a gear, elastic or not, whose wheels nothing else connects: gears hold
///         no centres
void require_common_carriers(const Model& model);

}  // namespace buckens::model
