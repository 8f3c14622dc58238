// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "buckens/mesh_io/mesh_text.h"
#include "buckens/mesh_io/tagged_mesh.h"

namespace buckens::mesh_io {

/// Reads a universal file: nodes (data set 2411 or 781), elements (2412), permanent groups (2435,
/// 2452, 2467, 2477). Others are left out with a note.
/// @throws InputError with file and line
TaggedMesh read_universal_file(MeshText& text, const std::string& file);

}  // namespace buckens::mesh_io
