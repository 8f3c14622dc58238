// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

namespace buckens::mesh_io {

/// Triangles on faces of a part and the tetrahedra inside, by numbers of their nodes.
struct PartMesh {
  struct Face {
    int number = 0;
    std::vector<std::size_t> triangles;  ///< three nodes each
  };
  std::unordered_map<std::size_t, Eigen::Vector3d> positions;
  std::vector<Face> faces;
  std::vector<std::size_t> tetrahedra;  ///< four nodes each
};

/// A face in front of a wall that one flat element fills.
struct FlatFace {
  int number = 0;
  double area = 0;
  double wall = 0;  ///< mean thickness where it is flat
};

/// From here on elements are flat, as sides of their triangles to the thickness of the wall:
/// tetrahedra of second order then make the lowest frequencies of plates 2 % too high, three times
/// as flat ones 4 %.
inline constexpr double kFlat = 8;

/// The faces of which a third at least is the base of flat elements, whose tips lie on the surface,
/// too.
std::vector<FlatFace> flat_faces(const PartMesh& mesh);

/// Smaller sizes for such faces: kFlat thicknesses, as far as about `most` elements allow it.
/// @param least, size bounds of what is chosen
/// @return by number of the face; those that would hardly change are left out
std::unordered_map<int, double> sizes_for_walls(const std::vector<FlatFace>& faces, double least,
                                                double size, double most);

}  // namespace buckens::mesh_io
