// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/model/model.h"

namespace buckens::stepping {

/// All bodies that a joint moves, some perhaps twice.
std::vector<int> bodies_of(const model::Model& model, const model::Joint& joint);

/// Which bodies deform by themselves, or are connected by joints with one that does: one entry for
/// each body, not zero for these.
std::vector<char> mesh_partners(const model::Model& model);

}  // namespace buckens::stepping
