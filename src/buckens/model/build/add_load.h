// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/loads/load_spec.h"
#include "buckens/model/build/marker_finder.h"
#include "buckens/model/spec/model_description.h"

namespace buckens::model {

/// Adds a load on markers of the model file to the model under construction.
/// @throws InputError, ModelError naming the load and its place in the file
void add_load(const loads::LoadSpec& spec, MarkerFinder& find);

/// Adds a force law written in code.
void add_own_force(const OwnForce& force, MarkerFinder& find);

}  // namespace buckens::model
