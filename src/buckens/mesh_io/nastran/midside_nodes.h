// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "buckens/fem/mesh/imported_mesh.h"
#include "buckens/mesh_io/nastran/coordinates.h"

namespace buckens::mesh_io {

/// Both corners of an edge, counted in the element.
using NastranEdge = std::array<int, 2>;

/// The edges on which an element has its mid-side nodes, in Nastran's order; empty if it has none.
std::span<const NastranEdge> nastran_edges(NastranElementKind kind);

/// Nodes in the middle of edges whose mid-side node a deck leaves out.
///
/// In solids the edge is straight and moves linearly between its ends: u = ½ (u_a + u_b). Shape
/// functions of the corners then are those of transition elements, and what is linear in space is
/// reproduced exactly. In shells rotations are linear, too, and the displacement along the normal n
/// is the parabola that belongs to them, u = ½ (u_a + u_b) + ⅛ n (d × n)·(θ_a − θ_b) with
/// d = x_b − x_a: a plate bends at constant curvature as with the node.
class NastranMidsides {
 public:
  NastranMidsides(NastranCoordinates& coordinates, fem::ImportedMesh& mesh)
      : coordinates_(coordinates), mesh_(mesh) {}

  /// The node of an edge, one for all elements there. @return its index
  /// @param normal unit normal of a shell; zero: a solid
  int node(int a, int b, const Eigen::Vector3d& normal, int line);

  /// Makes a node that a deck has in the middle of an edge follow its ends as that of a solid.
  /// @return whether it lies there; else nothing is done
  bool straighten(int node, int a, int b, int line);

 private:
  struct Middle {
    Eigen::Vector3d normal;
    int node = 0;
  };

  void tie(int node, int a, int b, const Eigen::Vector3d& normal, int line);

  NastranCoordinates& coordinates_;
  fem::ImportedMesh& mesh_;
  std::map<std::pair<int, int>, std::vector<Middle>> middles_;
  std::set<int> straightened_;
};

}  // namespace buckens::mesh_io
