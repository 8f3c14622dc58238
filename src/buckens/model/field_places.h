// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "buckens/model/field_spec.h"
#include "buckens/model/model.h"
#include "buckens/model/structure_from_spec.h"

namespace buckens::model {

/// Where fields of one body are recorded; numbers of the undivided mesh.
struct FieldPlaces {
  int whole = 0;              ///< index into Model::wholes, of a flexible body
  bool is_everywhere = true;  ///< all nodes and solid elements; the lists are empty
  std::vector<int> nodes;     ///< ascending
  std::vector<int> solids;    ///< solid elements, ascending
};

/// Finds the places that a model file names, in the order of the bodies.
///
/// Of an interface or a set of nodes the solids that touch them belong to it, of a set of faces
/// their elements.
/// @param meshes one per whole body, null if rigid
/// @throws InputError with the nearest name if there is no such body or place, or if it is rigid
std::vector<FieldPlaces> find_field_places(
    const FieldOutputSpec& spec, const Model& model,
    const std::vector<std::unique_ptr<NamedStructure>>& meshes);

}  // namespace buckens::model
