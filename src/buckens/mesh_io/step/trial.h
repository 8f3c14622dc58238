// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "buckens/mesh_io/step/mesh.h"
#include "buckens/mesh_io/step/ways.h"

namespace buckens::mesh_io {

/// What a trial works on.
struct StepTask {
  std::string step, named_copy, mesh;  ///< files; the second with colours that represent names
  std::size_t num_names = 0;
  StepRequest request;
  /// Directory of settings by which the kernel reads parts with thousands of faces in time; empty:
  /// its own settings. See write_quick_settings().
  std::string settings = {};
};

/// Meshes the part with the library of Gmsh and writes the mesh, in metres. To be called in a
/// separate process.
/// @return one line per message, colour, label, time and size; a first line that begins with
/// `error ` (no trial can help), `open ` (the surface is not closed, or seems so) or `failed ` if
/// there is no mesh
std::string mesh_in_trial(const StepTask& task, const StepTrial& trial);

}  // namespace buckens::mesh_io
