// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "buckens/mesh_io/step/mesh.h"

namespace buckens::mesh_io {

/// One way to mesh a part.
struct StepTrial {
  const char* what = "";  ///< for the note that says how it was done; "" for the usual way
  /// The kernel takes points nearer than 1e-7 as one, whatever the unit: small parts in metres lose
  /// detail that they keep in millimetres, while solids that touch only roughly glue better.
  bool in_millimetres = false;
  int algorithm = 6;      ///< of Gmsh for faces: 1 MeshAdapt, 5 Delaunay, 6 frontal
  double size = 1;        ///< as a part of the wanted one; if below 1, of chosen_size() if smaller
  double smallest = .25;  ///< where surfaces are curved, as a part of the size
  int in_a_turn = 8;      ///< elements; few of them cut through thin curved walls
  double tolerance = 0;   ///< for sewing, as a part of the part's diagonal; 0: as the file is
};

/// The ways that are tried, in this order, until one comes to a mesh.
const std::vector<StepTrial>& step_trials();
/// Those for parts whose surface is not closed; gaps of more than 4e-4 of the part stay open.
const std::vector<StepTrial>& sewing_trials();

/// What a trial works on.
struct StepTask {
  std::string step, named_copy, mesh;  ///< files; the second with colours that stand for names
  std::size_t num_names = 0;
  StepRequest request;
};

/// Meshes the part with the library of Gmsh and writes the mesh, in metres. To be called in a
/// process of its own.
/// @return one line per message, colour, label, time and size; a first line that begins with
/// `error ` (no trial can help), `open ` (the surface is not closed, or seems so) or `failed ` if
/// there is no mesh
std::string mesh_in_trial(const StepTask& task, const StepTrial& trial);

/// Edges of the elements of a part for which none is given [m]: a twentieth of its diagonal; less
/// where walls are thin, but no less than a thirtieth.
/// @param volume, area of all solids and faces
double chosen_size(double diagonal, double volume, double area);

/// About how many tetrahedra a part becomes: as many as fill the volume, but at least those that
/// stand on its faces.
double expected_elements(double size, double volume, double area);

}  // namespace buckens::mesh_io
