// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/model/build/marker_finder.h"
#include "buckens/model/spec/model_description.h"

namespace buckens::model {

/// Adds the signals to the model under construction, with the markers and coordinates they look at.
/// @throws ModelError naming the signal, if a joint has no such coordinate
void add_signals(const ModelDescription& description, MarkerFinder& find);

/// Finds the loads that signals look at and the order in which signals can be evaluated. To be
/// called when all loads are there, and again when functions take the place of values.
/// @throws ModelError naming the signals of an algebraic loop
void connect_signals(const ModelDescription& description, Model& model);

}  // namespace buckens::model
