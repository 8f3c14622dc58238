// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/model/check/finding.h"
#include "buckens/model/spec/model_description.h"

namespace buckens::model {

/// The first error in a description, in the order and the words of the model file; field paths are
/// those of the model file, "bodies.rod.beam.to".
///
/// Numbers that stay at their default count as not given.
Found check(const ModelDescription& description);

/// @throws InputError if check() finds something: with the place of the nearest spec that has one,
/// and the field path
void require_sound(const ModelDescription& description);

}  // namespace buckens::model
