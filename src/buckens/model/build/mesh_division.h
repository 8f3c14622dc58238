// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/body/frame_division.h"
#include "buckens/fem/assembly/structure_parts.h"
#include "buckens/model/build/structure_from_spec.h"

namespace buckens::model {

/// The mesh of a body cut into parts with a frame each.
struct MeshDivision {
  std::vector<NamedStructure> parts;  ///< with the named places on them
  /// For each node of the whole mesh its copies; `part` counts from 0 within the body.
  std::vector<std::vector<fem::PartPlace>> nodes;
  std::vector<fem::PartPlace> lines;
  std::vector<fem::PartPlace> solids;
  std::vector<int> straight_nodes;  ///< of the whole mesh
};

/// Memory that the interfaces at the cuts will need while stepping [bytes]: per part with n
/// variables and m interface rows four n×m panels, and eight m×m blocks of the joint equations.
double predicted_bytes(const MeshDivision& division);

/// @param memory available memory [bytes]
/// @throws ModelError if the prediction exceeds it, as for solids cut in many places
void require_memory(const MeshDivision& division, double memory);

/// @throws ModelError if there are more frames than elements, or links inside the mesh
MeshDivision divide_mesh(const NamedStructure& whole, const body::FrameDivision& frames);

}  // namespace buckens::model
