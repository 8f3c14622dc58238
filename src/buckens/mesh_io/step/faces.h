// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "buckens/fem/mesh/imported_mesh.h"
#include "buckens/fem/mesh/mesh_file_spec.h"

namespace buckens::mesh_io {

/// What the names of the sets of faces begin with.
inline constexpr const char* kFaceName = "face_";

/// Data of a STEP file about a face. The mesh has its nodes and its element faces as the sets
/// `face_<number>`.
struct StepFace {
  int number = 0;
  std::vector<std::array<int, 3>> colors;  ///< linear, 0 … 255; two between glued solids
  std::vector<std::string> labels;
};

/// Adds the face sets for colours and labels of the file: `color_255_0_0`, `bearing seat`.
void add_face_names(fem::ImportedMesh& mesh, const std::vector<StepFace>& faces);

/// Adds the face set and node set of one entry of `faces` of a model file.
/// @throws InputError at the entry if no face matches it
void name_faces(fem::ImportedMesh& mesh, const std::vector<StepFace>& faces,
                const fem::GeometryFaceSpec& spec);

}  // namespace buckens::mesh_io
