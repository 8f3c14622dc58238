// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/model/model.h"

namespace buckens::stepping {

/// All bodies that a joint moves, some perhaps twice.
std::vector<int> bodies_of(const model::Model& model, const model::Joint& joint);

/// Per body: not zero if its mesh moves by itself, or if joints connect it with a body whose mesh
/// does.
std::vector<char> mesh_partners(const model::Model& model);

}  // namespace buckens::stepping
