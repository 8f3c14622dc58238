// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace buckens::mesh_io {

/// What decides how many triangles a face becomes.
struct FaceExtent {
  double area = 0;
  double curvature = 0;       ///< the largest found at nine places
  std::vector<double> edges;  ///< their lengths
};

/// About how many triangles the faces become.
/// @param smallest least size where faces are curved
/// @param in_a_turn elements in a full turn of a curved face
double expected_triangles(const std::vector<FaceExtent>& faces, double size, double smallest,
                          int in_a_turn);

/// About how many elements and nodes a part becomes.
struct MeshOutlook {
  double elements = 0, nodes = 0;
};

/// The numbers are fitted to 53 public parts: four in five are met within a factor of two, all but
/// two within two and a half. Not among these are plates with many small holes: there Gmsh carries
/// the size at the holes far into the plate, so that one of them got twenty times as many.
MeshOutlook expected_mesh(double volume, double size, double triangles, int order);

/// At least so many, of second order, stand on the triangles of a surface that is meshed.
MeshOutlook expected_on_surface(double triangles);

}  // namespace buckens::mesh_io
