// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "buckens/fem/mesh/imported_mesh.h"
#include "buckens/fem/mesh/mesh_file_spec.h"
#include "buckens/mesh_io/step/faces.h"

namespace buckens::mesh_io {

/// How to mesh a part.
struct StepRequest {
  std::optional<double> size;  ///< upper bound for the element edges [m]; default: chosen
  int order = 2;               ///< 1 or 2
  std::string solid;           ///< name or number of the one solid to use; empty: all
};

/// A meshed part and the file's data about its faces.
struct StepMesh {
  fem::ImportedMesh mesh;
  std::vector<StepFace> faces;
  double size = 0;  ///< requested or chosen [m]
};

/// Meshes the solids of a STEP file with tetrahedra by the library of Gmsh, in a separate
/// process.
///
/// Lengths are in metres. Solids that touch are glued: they share faces and nodes there. Where
/// solids overlap, their common volume belongs to one of them, and `notes` say so. Every solid is a
/// property and an element set by its label in the file, every face a face set and node set
/// `face_1`, `face_2` …; colours and labels of faces are further face sets, `color_255_0_0` and the
/// label itself. Elements of second order have their mid-side nodes on the true surface, except
/// where an element would be inverted; `notes` then say so. Small radii get smaller elements, eight
/// per full circle but none below a quarter of `size`.
///
/// The default size is chosen_size(). Parts that cannot be meshed this way are tried by the methods
/// of step_trials() one after the other; faces that are not a solid are sewn together. `notes` say
/// what was done. The result does not depend on the machine as long as no trial times out.
///
/// @param text contents of the file
/// @throws InputError if the file is not a STEP file, has no solid and none can be made, or cannot
/// be meshed: with the reason, the place and what to do; IoError if it cannot be read or the
/// library is missing
StepMesh mesh_step(const std::filesystem::path& path, const std::string& text,
                   const StepRequest& request);

/// The same without the data about faces; reads the file.
fem::ImportedMesh mesh_step(const std::filesystem::path& path, const StepRequest& request);

/// The mesh with the names that a specification gives to faces.
/// @throws InputError if a name has no face
fem::ImportedMesh with_face_names(StepMesh part, const std::vector<fem::GeometryFaceSpec>& names);

}  // namespace buckens::mesh_io
