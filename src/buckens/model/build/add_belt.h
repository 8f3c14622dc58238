// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/loads/belt_spec.h"
#include "buckens/model/build/marker_finder.h"

namespace buckens::model {

/// Gives a load of the model under construction the markers and the force law of an elastic belt.
/// @param load with its name
/// @throws InputError, ModelError naming the belt and its place in the file
void set_belt(const loads::ElasticBeltSpec& spec, MarkerFinder& find, Load& load,
              const SourceLocation& where);

}  // namespace buckens::model
