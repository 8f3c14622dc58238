// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "buckens/spatial/triangle_list.h"

namespace buckens::loads {

/// Facets that bend less around a corner, or along an edge, are one face [rad].
inline constexpr double kFlatCorner = 1e-4;

/// Whether unit vectors lie in one plane through the origin: of normals around a point, that no
/// sharp corner is there.
bool are_in_plane(const std::vector<Eigen::Vector3d>& normals);

/// How the triangles of a surface hang together.
struct MeshTopology {
  std::vector<Eigen::Vector3d> points;         ///< one per place [m]
  std::vector<std::array<int, 3>> triangles;   ///< without those that have no area
  std::vector<Eigen::Vector3d> normals;        ///< unit vectors, one per triangle
  std::vector<double> areas;                   ///< [m²]
  std::vector<std::array<int, 3>> neighbours;  ///< across the edge from corner k to the next; −1
  std::vector<int> first_at, at_point;         ///< triangles at each point, those of k from
                                               ///< first_at[k] to first_at[k + 1]
  std::vector<int> patches;                    ///< of each triangle
  int num_patches = 0;
  std::vector<int> colours;  ///< of each patch
  int num_colours = 1;
  bool is_closed = false;

  /// @param smooth as of ContactMesh, @param most_colours that patches may have
  /// @throws InputError as ContactMesh
  MeshTopology(const spatial::TriangleList& list, double smooth, int most_colours);

  /// Angle of a triangle at its corner k [rad].
  double angle(std::size_t triangle, std::size_t k) const;

 private:
  void join_points(const spatial::TriangleList& list);
  void find_neighbours();
  void require_outwards() const;
  void find_patches(double smooth);
  void find_colours(int most);
};

}  // namespace buckens::loads
