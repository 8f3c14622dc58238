// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/loads/polyhedron.h"

namespace buckens::loads {

struct MeshTopology;

/// For each point of a surface whether it is a corner: where facets of more than two planes meet,
/// or where an open surface ends.
std::vector<char> corner_points(const MeshTopology& from);

/// The edges between patches that stand out; pieces that go on straight between corners are one
/// edge.
std::vector<Polyhedron::Edge> sharp_edges(const MeshTopology& from);

/// Those of a mesh, between its patches.
std::vector<Polyhedron::Edge> sharp_edges(const ContactMesh& mesh);

}  // namespace buckens::loads
