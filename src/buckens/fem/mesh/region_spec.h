// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "buckens/base/field.h"
#include "buckens/base/source_location.h"

namespace buckens::fem {

/// Nodes of a face named by the mesh generator or the mesh file.
struct NamedFaceSpec {
  static constexpr const char* kKey = "face";
  static constexpr const char* kDoc = "the nodes of a named face of the mesh, weighted by area";
  SourceLocation where;
  std::string name;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("name", name,
                      "x0, x1, y0, y1, z0, z1 of a box; bottom, top, side or inner, outer of round "
                      "meshes; a surface of a mesh file")
              .required()
              .shorthand()
              .like("x0"));
  }
};

/// Nodes by name, or by the name of a set.
struct NodeSetSpec {
  static constexpr const char* kKey = "set";
  static constexpr const char* kDoc = "nodes by name, one by one or as sets of a mesh file";
  SourceLocation where;
  std::vector<std::string> nodes;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("nodes", nodes,
                      "names of nodes; of a mesh file: nodes (`n` and the number), node sets, "
                      "surfaces")
              .required()
              .shorthand()
              .like("[corner_000, corner_010, corner_001, corner_011]"));
  }
};

/// Common to all selections by position.
struct PlaceSelection {
  SourceLocation where;
  std::optional<double> tolerance;  ///< [m]

  template <class Visitor>
  void tolerance_field(Visitor& visit) {
    visit(
        base::field("tolerance", tolerance, "distance up to which a node outside counts as inside")
            .in(base::kLength)
            .non_negative()
            .like("0.1 mm")
            .otherwise("1e-6 of the size of the mesh"));
  }
};

/// Nodes in a ball.
struct SphereSelection : PlaceSelection {
  static constexpr const char* kKey = "sphere";
  static constexpr const char* kDoc = "the nodes within a distance from a point";
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< model axes [m]
  double radius = 0;                                 ///< [m]

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("center", center, "its centre in model axes")
              .in(base::kLength)
              .required()
              .like("[1 m, 0, 0]"));
    visit(base::field("radius", radius, "its radius")
              .in(base::kLength)
              .required()
              .non_negative()
              .like("30 mm"));
    tolerance_field(visit);
  }
};

/// Nodes in a block with edges along the model axes.
struct BoxSelection : PlaceSelection {
  static constexpr const char* kKey = "box";
  static constexpr const char* kDoc = "the nodes in a block with edges along the model axes";
  Eigen::Vector3d from = Eigen::Vector3d::Zero();  ///< model axes [m]
  Eigen::Vector3d to = Eigen::Vector3d::Zero();    ///< the opposite corner [m]

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("from", from, "a corner in model axes")
              .in(base::kLength)
              .required()
              .like("[0, -50 mm, -50 mm]"));
    visit(base::field("to", to, "the opposite corner")
              .in(base::kLength)
              .required()
              .like("[20 mm, 50 mm, 50 mm]"));
    tolerance_field(visit);
  }
};

/// Nodes in a cylinder, such as those of a bore.
struct CylinderSelection : PlaceSelection {
  static constexpr const char* kKey = "cylinder";
  static constexpr const char* kDoc = "the nodes in a round cylinder, such as those of a bore";
  Eigen::Vector3d from = Eigen::Vector3d::Zero();  ///< centre of one end, model axes [m]
  Eigen::Vector3d to = Eigen::Vector3d::UnitX();   ///< centre of the other end [m]
  double radius = 0;                               ///< [m]

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("from", from, "centre of one end in model axes")
              .in(base::kLength)
              .required()
              .like("[0, 0, -20 mm]"));
    visit(base::field("to", to, "centre of the other end")
              .in(base::kLength)
              .required()
              .like("[0, 0, 20 mm]"));
    visit(base::field("radius", radius, "its radius")
              .in(base::kLength)
              .required()
              .non_negative()
              .like("15 mm"));
    tolerance_field(visit);
  }
};

/// Nodes on a plane.
struct PlaneSelection : PlaceSelection {
  static constexpr const char* kKey = "plane";
  static constexpr const char* kDoc = "the nodes on a plane";
  Eigen::Vector3d point = Eigen::Vector3d::Zero();    ///< model axes [m]
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  ///< any non-zero length

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("point", point, "a point of the plane in model axes")
              .in(base::kLength)
              .required()
              .like("[0, 0, 0]"));
    visit(base::field("normal", normal, "its normal").required().like("[1, 0, 0]"));
    tolerance_field(visit);
  }
};

/// The ways to select nodes of a mesh.
using RegionSpec = std::variant<NamedFaceSpec, NodeSetSpec, SphereSelection, BoxSelection,
                                CylinderSelection, PlaneSelection>;

/// Distance of a point from the selected region [m]; 0 inside.
double distance(const SphereSelection& sphere, const Eigen::Vector3d& point);
double distance(const BoxSelection& box, const Eigen::Vector3d& point);
double distance(const CylinderSelection& cylinder, const Eigen::Vector3d& point);
double distance(const PlaneSelection& plane, const Eigen::Vector3d& point);

}  // namespace buckens::fem
