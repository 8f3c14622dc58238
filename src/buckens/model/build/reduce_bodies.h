// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/body/basis_store.h"
#include "buckens/model/model.h"
#include "buckens/model/spec/model_description.h"

namespace buckens::model {

/// Replaces the meshes of those bodies by reduced bases that the model file asks this for. All rows
/// of the markers must be known.
/// @param store keeps bases between runs; null: nothing is kept
/// @throws InputError where the description contradicts itself, ModelError where a body has no
///         basis
void reduce_bodies(const ModelDescription& description, Model& model, body::BasisStore* store);

}  // namespace buckens::model
