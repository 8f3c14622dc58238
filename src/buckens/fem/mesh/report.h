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

/// What can be said about a mesh before a body is made of it.
struct MeshReport {
  struct Kind {
    CellKind kind;
    std::string source;
    int count;
  };
  struct Property {
    std::string name, material;
    int elements = 0;
    double size = 0;  ///< of solids the volume, of shells the area, of lines the length
    double mass = 0;  ///< zero where the file gives no density
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
  /// Those of one name and material together; elements without one under the name "".
  std::vector<Property> properties;
  std::vector<NamedCount> node_sets, element_sets;
  std::vector<Faces> face_sets;
  Eigen::AlignedBox3d box;                                  ///< [m]
  double volume = 0;                                        ///< of the solids [m³]
  Eigen::Vector3d volume_centre = Eigen::Vector3d::Zero();  ///< [m]
  /// Of elements and point masses whose density the file gives.
  double mass = 0;
  Eigen::Vector3d mass_centre = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the mass centre [kg m²]
  int without_density = 0;                            ///< elements
  double worst_aspect = 1;
  std::int64_t worst_element = 0;
  Eigen::Vector3d worst_centre = Eigen::Vector3d::Zero();  ///< mean of its nodes [m]
  std::vector<std::int64_t> inverted;  ///< numbers of elements that no body can be made of
  /// Numbers of those that are inverted or flat at a node, not where they are integrated.
  std::vector<std::int64_t> inverted_at_nodes;
  std::vector<std::pair<std::int64_t, std::int64_t>> duplicate_nodes;  ///< numbers of nodes
  int pieces = 0;                        ///< parts that nothing connects
  std::vector<std::int64_t> free_nodes;  ///< that nothing uses
  std::vector<std::string> warnings;     ///< sentences on what is probably a mistake
};

/// @param mesh in SI units
/// @param units_given whether a user said in which units the file is; if not, a part of hundreds of
/// metres probably is in millimetres
MeshReport report_mesh(const ImportedMesh& mesh, bool units_given);

}  // namespace buckens::fem
