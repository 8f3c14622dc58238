// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace buckens::mesh_io {

/// One way to mesh a part.
struct StepTrial {
  const char* what = "";  ///< for the note on how it was done; "" for the usual method
  /// The kernel merges points closer than 1e-7 in any unit: small parts in metres lose detail that
  /// they keep in millimetres, while solids that touch only roughly glue better.
  bool in_millimetres = false;
  int algorithm = 6;      ///< of Gmsh for faces: 1 MeshAdapt, 5 Delaunay, 6 frontal
  double size = 1;        ///< as a fraction of the requested; below 1: of chosen_size() if smaller
  double smallest = .25;  ///< where surfaces are curved, as a fraction of the size
  int in_a_turn = 8;      ///< elements; few of them cut through thin curved walls
  double tolerance = 0;   ///< for sewing, as a fraction of the diagonal; 0: as the file is
};

/// The methods tried in this order until one produces a mesh: first those in metres, for the part
/// is read once in each unit.
const std::vector<StepTrial>& step_trials();
/// Those for parts whose surface is not closed; gaps above 4e-4 of the part's size stay open.
const std::vector<StepTrial>& sewing_trials();

/// Default edge length of the elements of a part [m]: a twentieth of its diagonal; less if walls
/// are thin, but no less than a thirtieth.
/// @param volume, area of all solids and faces
double chosen_size(double diagonal, double volume, double area);

}  // namespace buckens::mesh_io
