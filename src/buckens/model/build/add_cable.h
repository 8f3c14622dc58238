// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/loads/cable_spec.h"
#include "buckens/model/build/marker_finder.h"

namespace buckens::model {

/// Gives a load of the model under construction the markers and the force law of a cable.
/// @param load with its name
/// @throws InputError, ModelError naming the cable and its place in the file
void set_cable(const loads::CableSpec& spec, MarkerFinder& find, Load& load,
               const SourceLocation& where);

}  // namespace buckens::model
