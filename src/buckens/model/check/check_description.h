// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/model/check/finding.h"
#include "buckens/model/spec/model_description.h"

namespace buckens::model {

/// The first thing that is wrong with a description, in the order of the model file and in its
/// words; field paths are those of the model file, "bodies.rod.beam.to".
///
/// Numbers that stay at their default count as not given.
Found check(const ModelDescription& description);

/// @throws InputError if check() finds something: with the place of the nearest spec that knows
///         one, and the field path
void require_sound(const ModelDescription& description);

}  // namespace buckens::model
