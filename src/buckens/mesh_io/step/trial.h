// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <exception>
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

class GluedPart;

/// A line that says how long something took.
std::string time_line(const char* what, double seconds);

/// Meshes the part with the library of Gmsh and writes the mesh, in metres. To be called in a
/// separate process, since it changes the part.
/// @return one line per message, colour, label, time and size; a first line that begins with
/// `error ` (no trial can help), `open ` (the surface is not closed, or seems so) or `failed ` if
/// there is no mesh
std::string mesh_in_trial(GluedPart& part, const StepTask& task, const StepTrial& trial);

/// What to say of an exception, in the same form.
std::string outcome_of(const std::exception& error);

}  // namespace buckens::mesh_io
