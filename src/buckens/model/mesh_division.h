// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/body/frame_division.h"
#include "buckens/fem/structure_parts.h"
#include "buckens/model/structure_from_spec.h"

namespace buckens::model {

/// The mesh of a body cut into the parts that get a frame each.
struct MeshDivision {
  std::vector<NamedStructure> parts;  ///< with the named places that lie on them
  /// Per node of the whole mesh its copies; `part` counts from 0 within the body.
  std::vector<std::vector<fem::PartPlace>> nodes;
  std::vector<fem::PartPlace> lines;
  std::vector<int> straight_nodes;  ///< of the whole mesh
};

/// @throws ModelError if there are more frames than elements
MeshDivision divide_mesh(const NamedStructure& whole, const body::FrameDivision& frames);

}  // namespace buckens::model
