// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "buckens/fem/line/section.h"
#include "buckens/fem/mesh/cell_kind.h"
#include "buckens/spatial/pose.h"

namespace buckens::results {

/// Index of the ground in place of a body.
inline constexpr int kGroundBody = -1;

/// A marker as a viewer draws it.
struct GeometryMarker {
  std::string name;
  int node = -1;       ///< node that carries it; −1: fixed to the body frame
  spatial::Pose X_BF;  ///< in the undeformed body [m]
};

/// `solid` if a mesh has solid elements, possibly besides beams and bars.
enum class BodyKind { rigid, beam, solid };

/// The undeformed shape of one body in its body frame B.
struct GeometryBody {
  std::string name;
  BodyKind kind = BodyKind::rigid;
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> nodes;  ///< N×3 [m]; none if rigid
  std::vector<std::array<int, 2>> elements;                         ///< E pairs of nodes: lines
  std::vector<std::array<double, 2>>
      radius;  ///< E, of the circle around the section at both ends [m]
  /// Outlines of cross-sections, each once. None if lines represent something else, and in runs of
  /// older versions: they are then drawn as round tubes.
  std::vector<std::vector<fem::SectionLoop>> sections;
  std::vector<std::array<int, 2>> element_sections;  ///< E, at both ends; empty without sections
  std::vector<Eigen::Vector3d> element_y;  ///< E, local y axis, body axes; empty without sections
  /// F faces on the surface of solids: nodes counter-clockwise seen from outside, the fourth −1 for
  /// triangles.
  std::vector<std::array<int, 4>> faces;
  std::vector<int> face_elements;         ///< F, solid element of each face
  std::vector<fem::CellKind> cell_kinds;  ///< S, of the solids, then the shells
  std::vector<int> cell_nodes;            ///< nodes of all of them, consecutively
  /// P places of fields at nodes: the node of each. A node occurs once for each material that meets
  /// at it, and for each part of a divided body.
  std::vector<int> field_nodes;
  std::vector<int> field_elements;  ///< solid elements of fields at elements, ascending
  /// F, for each corner of a face its place in field_nodes, −1 if there is none.
  std::vector<std::array<int, 4>> face_places;
  /// As cell_nodes, the place of each corner, −1 if there is none; empty if nodes and places
  /// correspond one to one.
  std::vector<int> cell_places;
  std::vector<GeometryMarker> markers;
};

/// One of the two places that a joint or force element connects.
struct GeometrySide {
  int body = kGroundBody;
  int marker = -1;                                     ///< of that body; −1: position only
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< body frame, world for the ground [m]
};

struct GeometryJoint {
  std::string name;
  std::string type;  ///< as in the model file: "revolute" …
  std::array<GeometrySide, 2> between;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< unit vector, axes of the first body
};

/// A load that can be drawn as arrows. Its values over time are the channel `loads/<name>/value`.
struct GeometryLoad {
  std::string name;
  std::string kind;        ///< as in the model file: "force", "pressure", "traction" …
  int body = kGroundBody;  ///< the ground if a load acts on all bodies
  bool follows = false;    ///< directions and values rotate with the body
  std::string unit;        ///< of the values
  std::vector<Eigen::Vector3d> positions;  ///< feet of the arrows in the undeformed body frame [m]
  std::vector<int> nodes;                  ///< that carry them, −1 if none
  /// Unit vectors in body axes if there is a single value. Empty if three values give the
  /// direction.
  std::vector<Eigen::Vector3d> directions;
};

/// A shape that bodies touch or roll with.
struct GeometryShape {
  std::string name;  ///< of its contact or joint
  /// "plane", "sphere", "socket", "bore", "capsule", "cylinder", "box", "mesh", "wheel", "curve";
  /// "cam": the same as the rim of a disc
  std::string kind;
  GeometrySide on;
  Eigen::Quaterniond q =
      Eigen::Quaterniond::Identity();               ///< axes of the shape in those of the body
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< of planes and long shapes, own axes
  double radius = 0;                                ///< [m]
  double length = 0;  ///< between ends, of long shapes; of the edge of wheels [m]
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< edges of boxes [m]
  std::vector<Eigen::Vector3d> points;             ///< of meshes and curves, own axes [m]
  std::vector<std::array<int, 3>> triangles;
};

/// A cable or belt, and what it runs around.
struct GeometryCable {
  std::string name;
  std::string kind;  ///< as in the model file: "cable", "elastic-belt", "belt"
  bool is_closed = false;
  int first_pulley = 0;                             ///< side in whose body the axis stands
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< unit vector, axes of that body
  std::vector<GeometrySide> sides;                  ///< in the order in which it passes them
  /// One per side [m]; negative: it runs around clockwise, 0: it ends there.
  std::vector<double> radii;
};

/// What a viewer needs besides the records and never changes during a run.
struct Geometry {
  std::vector<GeometryBody> bodies;
  std::vector<GeometryJoint> joints;
  std::vector<GeometryLoad> loads;
  std::vector<GeometryShape> shapes;
  std::vector<GeometryCable> cables;
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< [m/s²] world
  std::string planar;                                 ///< "xy", "yz", "zx"; empty in 3-D
};

}  // namespace buckens::results
