// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/step/estimate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace buckens::mesh_io {

namespace {

constexpr double kTetrahedron = 0.1179;  // volume of a regular one with edges of length 1
constexpr double kTriangle = 0.433;      // area of a regular one
// Elements of bulky parts are smaller than the wanted size, most of them; thin parts have so many
// for each triangle of the surface.
constexpr double kInBulk = 1.4, kOnTriangle = 3.5;
// Once the surface is meshed and its triangles are not estimated any more: thin parts.
constexpr double kOnSurface = 1.5;
// Nodes of second order, by elements and triangles. With Euler's formula a mesh without nodes
// inside has 1 and 1.5, a large block 4/3 and 1.
constexpr double kNodesOfElement = 1.58, kNodesOfTriangle = 1.12;
// Of first order in a block: five and a half elements around a node.
constexpr double kFlatNodes = 1 / 5.5;

}  // namespace

double expected_triangles(const std::vector<FaceExtent>& faces, double size, double smallest,
                          int in_a_turn) {
  double out = 0;
  for (const FaceExtent& face : faces) {
    const double bent = 2 * std::numbers::pi / (in_a_turn * std::max(face.curvature, 1e-12 / size));
    const double own = std::clamp(bent, smallest, size);
    double on_edges = 0;
    for (const double edge : face.edges) on_edges += std::max(1.0, edge / own);
    out += std::max(face.area / (kTriangle * own * own), on_edges - 2);
  }
  return out;
}

MeshOutlook expected_mesh(double volume, double size, double triangles, int order) {
  MeshOutlook out;
  out.elements =
      std::max(kInBulk * volume / (kTetrahedron * std::pow(size, 3)), kOnTriangle * triangles);
  out.nodes = order == 2 ? kNodesOfElement * out.elements + kNodesOfTriangle * triangles
                         : kFlatNodes * out.elements + triangles / 3;
  return out;
}

MeshOutlook expected_on_surface(double triangles) {
  const double elements = kOnSurface * triangles;
  return {elements, kNodesOfElement * elements + kNodesOfTriangle * triangles};
}

}  // namespace buckens::mesh_io
