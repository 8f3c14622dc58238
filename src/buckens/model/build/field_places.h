// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "buckens/model/build/structure_from_spec.h"
#include "buckens/model/model.h"
#include "buckens/model/spec/field_spec.h"

namespace buckens::model {

/// Nodes and elements of a body whose fields are recorded, numbered as in the undivided mesh.
struct FieldPlaces {
  int whole = 0;              ///< index into Model::wholes
  bool is_everywhere = true;  ///< all nodes, solid elements and interfaces; the lists are empty
  std::vector<int> nodes;     ///< ascending
  std::vector<int> solids;    ///< solid elements, ascending
  std::vector<std::string> names;  ///< names in the model file, of loads at interfaces
};

/// The part after the body in "body/place"; empty if only a body is named.
std::string part_of_place(const std::string& text);

/// Finds the places named in a model file, in the order of the bodies.
///
/// An interface or node set includes the adjacent solids, a set of faces their elements.
/// For fields of loads at interfaces, the names of rigid bodies and of markers of any body are
/// also valid.
/// @pre joints and loads are in the model
/// @param meshes one per whole body, null if rigid
/// @throws InputError with the closest name if there is no such body or place, or if it is rigid
/// and its loads are not requested
std::vector<FieldPlaces> find_field_places(
    const FieldOutputSpec& spec, const Model& model,
    const std::vector<std::unique_ptr<NamedStructure>>& meshes);

}  // namespace buckens::model
