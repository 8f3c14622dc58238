// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/fem/mesh/imported_mesh.h"

namespace buckens::fem {

/// Moves the mid-side nodes of inverted tet10 elements (even if at one node only) to the middle of
/// their edges, and those of neighbours that become inverted by it. Meshes of curved surfaces have
/// a few such elements where elements are large compared with a radius.
/// @return number of elements with moved nodes
int straighten_inverted(ImportedMesh& mesh);

}  // namespace buckens::fem
