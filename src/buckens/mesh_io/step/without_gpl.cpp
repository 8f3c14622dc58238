// SPDX-License-Identifier: Apache-2.0
// What a build with BUCKENS_GPL=OFF takes instead of the sources that call the library of Gmsh.
#include "buckens/mesh_io/step/unit_trials.h"

namespace buckens::mesh_io {

bool is_without_solid(const TrialOutcome&) { return false; }

std::vector<TrialOutcome> try_in_one_unit(const StepTask&, const UnitTrials&,
                                          const files::IsolatedListener&) {
  TrialOutcome out;
  out.lines =
      "error STEP files are meshed by the library of Gmsh, which is under the GPL, and this "
      "program was built without it (BUCKENS_GPL=OFF). Mesh the part with another program and read "
      "its mesh (`mesh: {file: …}`), or build with BUCKENS_GPL=ON";
  return {out};
}

}  // namespace buckens::mesh_io
