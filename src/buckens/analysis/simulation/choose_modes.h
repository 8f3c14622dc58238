// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "buckens/model/spec/model_description.h"

namespace buckens::analysis {

/// Replaces `reduction: auto` by Craig–Bampton bases with as many modes as needed.
///
/// A trial run with full meshes, over the first 400 steps or the whole duration if that is shorter
/// (with step control a fifth of it), is repeated with 1, 2, 4, … modes. A number suffices when all
/// markers of the model agree with the full meshes in position within the tolerance, relative to
/// the largest elastic displacement of a marker of these bodies. All bodies get the same number. If
/// half the variables of a mesh do not suffice, full meshes are kept.
/// @param notes receives a sentence on the choice and its accuracy
/// @param say called before each trial run; may be empty
/// @throws InputError if the model has no `simulation` or keeps an automatic basis in a file
void choose_modes(model::ModelDescription& description, std::vector<std::string>& notes,
                  const std::function<void(const std::string&)>& say = {});

}  // namespace buckens::analysis
