// SPDX-License-Identifier: Apache-2.0
// What a build with BUCKENS_GPL=OFF takes instead of trial.cpp, which calls the library of Gmsh.
#include "buckens/mesh_io/step/trial.h"

namespace buckens::mesh_io {

std::string mesh_in_trial(const StepTask&, const StepTrial&) {
  return "error STEP files are meshed by the library of Gmsh, which is under the GPL, and this "
         "program was built without it (BUCKENS_GPL=OFF). Mesh the part by another program and "
         "read its mesh (`mesh: {file: …}`), or build with BUCKENS_GPL=ON";
}

}  // namespace buckens::mesh_io
