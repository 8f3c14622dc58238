// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/mesh_io/step/mesh.h"

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

/// The methods tried in this order until one produces a mesh.
const std::vector<StepTrial>& step_trials();
/// Those for parts whose surface is not closed; gaps above 4e-4 of the part's size stay open.
const std::vector<StepTrial>& sewing_trials();

/// What a trial works on.
struct StepTask {
  std::string step, named_copy, mesh;  ///< files; the second with colours that represent names
  std::size_t num_names = 0;
  StepRequest request;
};

/// Meshes the part with the library of Gmsh and writes the mesh, in metres. To be called in a
/// separate process.
/// @return one line per message, colour, label, time and size; a first line that begins with
/// `error ` (no trial can help), `open ` (the surface is not closed, or seems so) or `failed ` if
/// there is no mesh
std::string mesh_in_trial(const StepTask& task, const StepTrial& trial);

/// Default edge length of the elements of a part [m]: a twentieth of its diagonal; less if walls
/// are thin, but no less than a thirtieth.
/// @param volume, area of all solids and faces
double chosen_size(double diagonal, double volume, double area);

/// Approximate number of tetrahedra of a part: as many as fill the volume, but at least those on
/// its faces.
double expected_elements(double size, double volume, double area);

}  // namespace buckens::mesh_io
