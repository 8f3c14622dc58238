// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "buckens/model/build/build_model.h"

namespace buckens::analysis {

/// Whether to make meshes finer or coarser, by a factor of two.
enum class MeshChange { finer, coarser };

/// What was done to the meshes of a model.
struct MeshRefinement {
  std::vector<std::string> changed;    ///< bodies
  std::vector<std::string> unchanged;  ///< flexible bodies whose meshes were not generated
  /// Parts of STEP files with their size of elements [m]; not changed here.
  std::vector<std::pair<std::string, double>> geometries;
  bool is_possible = true;  ///< false: a number of divisions cannot be halved
  double growth = 1;        ///< largest factor of nodal variables of a body
};

/// Divides generated meshes twice or half as finely. Sensors at numbered line elements keep their
/// positions.
MeshRefinement refine_meshes(model::ModelDescription& description, MeshChange change);

/// Gives bodies made of beams twice as many frames if they have enough elements.
/// @return their names
std::vector<std::string> refine_frames(model::ModelDescription& description);

}  // namespace buckens::analysis
