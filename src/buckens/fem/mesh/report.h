// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "buckens/fem/mesh/imported_mesh.h"

namespace buckens::fem {

/// A summary of a mesh before a body is made of it.
struct MeshReport {
  struct Kind {
    CellKind kind;
    std::string source;
    int count;
  };
  struct Property {
    std::string name, material;
    int elements = 0;
    double size = 0;  ///< volume of solids, area of shells, length of lines
    double mass = 0;  ///< zero if the file gives no density
  };
  struct NamedCount {
    std::string name;
    int count;
  };
  struct Faces {
    std::string name;
    int count;
    double area;             ///< by the corners [m²]
    Eigen::Vector3d centre;  ///< [m]
  };

  int nodes = 0, elements = 0;
  int variables = 0;  ///< three per node, six per node of shells and beams
  std::vector<Kind> kinds;
  /// Grouped by name and material; elements without one under the name "".
  std::vector<Property> properties;
  std::vector<NamedCount> node_sets, element_sets;
  std::vector<Faces> face_sets;
  Eigen::AlignedBox3d box;                                  ///< [m]
  double volume = 0;                                        ///< of the solids [m³]
  Eigen::Vector3d volume_centre = Eigen::Vector3d::Zero();  ///< [m]
  /// Of point masses, and of elements whose density the file gives.
  double mass = 0;
  Eigen::Vector3d mass_centre = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the mass centre [kg m²]
  int without_density = 0;                            ///< elements
  double worst_aspect = 1;
  std::int64_t worst_element = 0;
  Eigen::Vector3d worst_centre = Eigen::Vector3d::Zero();  ///< mean of its nodes [m]
  std::vector<std::int64_t> inverted;  ///< numbers of elements that no body can be made of
  /// Numbers of elements that are inverted or flat at a node, but not where they are integrated.
  std::vector<std::int64_t> inverted_at_nodes;
  std::vector<std::pair<std::int64_t, std::int64_t>> duplicate_nodes;  ///< numbers of nodes
  int pieces = 0;                                                      ///< unconnected parts
  std::vector<std::int64_t> free_nodes;                                ///< not used by anything
  std::vector<std::string> warnings;  ///< sentences on probable mistakes
};

/// @param mesh in SI units
/// @param units_given whether the user stated the units of the file; if not, a part of hundreds of
/// metres is probably in millimetres
MeshReport report_mesh(const ImportedMesh& mesh, bool units_given);

}  // namespace buckens::fem
