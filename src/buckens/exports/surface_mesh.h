// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "buckens/results/geometry.h"

namespace buckens::exports {

/// The visible surface of a body, in its undeformed frame: triangles on its solids, tubes around
/// its beams and bars.
struct SurfaceMesh {
  Eigen::Matrix3Xf positions;            ///< of the vertices [m]
  std::vector<int> nodes;                ///< node with which each vertex moves
  std::vector<std::uint32_t> triangles;  ///< three vertices each, counter-clockwise from outside
  std::vector<std::uint32_t> lines;      ///< two vertices each; of rigid bodies only, whose
                                         ///< vertices belong to no node (−1)
};

SurfaceMesh surface_mesh(const results::GeometryBody& body);

}  // namespace buckens::exports
