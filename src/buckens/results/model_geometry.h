// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/model/model.h"
#include "buckens/results/geometry.h"

namespace buckens::results {

/// The mesh of a whole body; null for rigid ones.
const fem::FeModel* mesh_of(const model::Model& model, const model::WholeBody& whole);

/// The undeformed shapes of all bodies and their connections.
Geometry model_geometry(const model::Model& model);

}  // namespace buckens::results
