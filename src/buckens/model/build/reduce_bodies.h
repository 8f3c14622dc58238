// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/body/basis_store.h"
#include "buckens/model/model.h"
#include "buckens/model/spec/model_description.h"

namespace buckens::model {

/// Replaces meshes by reduced bases for the bodies whose model-file entry requests it. All rows of
/// the markers must be known.
/// @param store stores bases between runs; null: nothing is stored
/// @throws InputError if the description contradicts itself, ModelError if a body has no
/// basis
void reduce_bodies(const ModelDescription& description, Model& model, body::BasisStore* store);

}  // namespace buckens::model
