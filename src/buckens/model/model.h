// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <compare>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "buckens/body/body.h"
#include "buckens/joints/beam_track.h"
#include "buckens/joints/coordinate_term.h"
#include "buckens/joints/joint.h"
#include "buckens/joints/joint_coordinate.h"
#include "buckens/joints/named_coordinate.h"
#include "buckens/loads/force_element.h"
#include "buckens/model/marker_id.h"
#include "buckens/model/signal.h"
#include "buckens/model/whole_body.h"
#include "buckens/spatial/plane.h"

namespace buckens::loads {
struct ContactShape;
}

namespace buckens::model {

struct ContactGroup;

/// A joint coordinate in a coupler.
struct CoupledCoordinate {
  int coordinate = 0;  ///< index into Model::coordinates
  joints::CoordinateTerm term;
};

/// The beam along which a joint slides, node by node.
struct Track {
  joints::BeamTrack shape;
  std::vector<MarkerId> nodes;   ///< one per node of `shape`, on one body or on its parts
  std::vector<MarkerId> bodies;  ///< one of these for every body that has some
  double placed = 0;             ///< s of the slider as placed [m]
};

/// Joint between two markers, with its position in λ.
struct Joint {
  std::string name;
  joints::JointType type = joints::JointType::fixed;
  MarkerId first, second;
  Eigen::Vector3d axis_F = Eigen::Vector3d::UnitZ();
  /// Of a universal joint: the arm fixed to the second body, as placed, unit vector in F.
  Eigen::Vector3d arm_F = Eigen::Vector3d::Zero();
  std::vector<joints::ConstraintRow> rows;
  /// Coordinates for laws, drives, sensors and signals; those in use are in Model::coordinates.
  std::vector<joints::NamedCoordinate> coordinates;
  int first_row = 0;    ///< of λ
  int first_state = 0;  ///< of its rows in RowMemory::rows
  /// For a coupler or a drive of a coordinate, which has one row between the markers of all these
  /// coordinates; the markers of the joint are those of the first. Empty for all other joints.
  std::vector<CoupledCoordinate> coupled;
  /// For a slider on a beam, whose first body is where the second marker currently is. Null for all
  /// other joints.
  std::shared_ptr<const Track> track;
  /// For a belt: radii of its pulleys, the second negative if the belt is crossed [m]; 0 for all
  /// other joints.
  std::array<double, 2> pulleys{0, 0};
  SourceLocation where;  ///< in the model file; that of the body for ties
  /// Joins the parts of a divided body; not in a model file.
  bool is_tie = false;
};

/// A coordinate between two markers that a force law, a coupler, a drive or a sensor needs.
struct Coordinate {
  int joint = -1;  ///< index into Model::joints of the joint that it belongs to, −1: none
  MarkerId first, second;
  joints::JointCoordinate law;
  base::CoordinateChoice which = base::CoordinateChoice::displacement;  ///< of those of the joint
};

/// A joint driven by a signal.
struct Drive {
  int joint = 0;   ///< index into Model::joints; its last row is steered
  int signal = 0;  ///< index into SignalSet::all: its angle [rad] or displacement [m]
};

/// Position at which a distributed load is drawn as an arrow.
struct LoadFoot {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();   ///< model axes [m]
  int node = -1;                                     ///< near it, in the undivided mesh
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< of a face, inwards; zero: none
};

/// The part of a body over which a load is distributed.
struct LoadRegion {
  std::string place;                             ///< as the model file names it: "piston/crown"
  double extent = 0;                             ///< area, length, mass or volume
  std::string unit;                              ///< of the extent: "m^2", "m", "kg" or "m^3"
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  ///< mean place, body frame [m]
  std::vector<LoadFoot> feet;                    ///< one per face or line element; may be empty
};

/// Load or force law between two markers. A load of the model file on a body with several frames,
/// or on all bodies, appears here once for each body concerned.
struct Load {
  std::string name;
  std::string kind;  ///< key in the model file
  std::string unit;  ///< of the values by laws of time, if there are any
  std::shared_ptr<const loads::ForceElement> element;
  MarkerId first, second;
  std::vector<MarkerId> others;  ///< behind them, of cables
  /// For contacts of two bodies: the shape on each marker.
  std::shared_ptr<const std::array<loads::ContactShape, 2>> shapes;
  bool is_among_joints = false;  ///< in the model file
  int joint = -1;                ///< whose reaction it depends on, −1: none
  int coordinate = -1;           ///< index into Model::coordinates on which it acts, −1: none
  int first_state = 0;           ///< its own states in RowMemory::laws
  int rigid_row = -1;            ///< its number among the rigid rows of the model, −1: none
  /// Interface row of the first body along which Action::along_pattern acts; −1: none.
  int pattern_row = -1;
  std::optional<LoadRegion> region;  ///< of distributed loads
};

/// Two members of a contact group that touch or are close.
struct NearPair {
  int group = 0;  ///< index into Model::contact_groups
  int first = 0;  ///< index into ContactGroup::members: the surface
  int second = 0;
  auto operator<=>(const NearPair&) const = default;
};

/// Loads of a pair in a rigid contact group: for each contact point a stop, then its directions of
/// friction. Each has a coordinate.
struct PairLoads {
  NearPair pair;
  std::size_t first = 0;     ///< of the loads, index into Model::loads
  std::size_t count = 0;     ///< of them, and of their coordinates
  int first_coordinate = 0;  ///< index into Model::coordinates
  int first_state = 0;       ///< of all of them in RowMemory::laws
  int num_states = 0;
};

/// A checked mechanism: bodies, joints and loads. It is constant after build(), except pair_loads
/// and their data in the copy that a simulation has of a model with rigid contact groups.
struct Model {
  std::string title;
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< [m/s²] world
  /// Index of the first of three settings in SignalSet::all with its components, if events change
  /// it; −1: they do not. See dynamics::gravity_at().
  int gravity_settings = -1;
  std::optional<spatial::Plane> planar;
  std::vector<body::Body> bodies;
  /// The bodies of the model file in its order. Empty in models made without one.
  std::vector<WholeBody> wholes;
  std::vector<Joint> joints;
  std::vector<Load> loads;
  std::vector<Coordinate> coordinates;
  /// For loads that are contacts among many bodies; see model/contact_group.h.
  std::vector<std::shared_ptr<const ContactGroup>> contact_groups;
  /// For the pairs in rigid groups that are currently close, ascending: the last loads and
  /// coordinates (model/build/rigid_pairs.h).
  std::vector<PairLoads> pair_loads;
  SignalSet signals;
  std::vector<Drive> drives;
  /// World origin of this model in that of the model file [m]: zero unless the mechanism is so far
  /// away that positions would lose digits. All positions in the library are relative to it; add it
  /// for display.
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  std::vector<spatial::Pose> placed;  ///< X_WB of each body as placed
  double length = 1.0;                ///< characteristic length L [m]
  std::vector<std::string> notes;     ///< what a user should know about the model

  int num_constraint_rows() const;
  int num_law_states() const;
  int num_rigid_rows() const;
  const Load& load_of_rigid_row(int row) const;
  /// Whether there are rigid rows, or may be once bodies come close.
  bool may_have_rigid_rows() const;
  int num_row_states() const;
  /// Joint, and row within it, of a row of λ.
  std::pair<const Joint*, int> owner_of_row(int row) const;
  int find_body(const std::string& name) const;
  /// Index into `wholes` of the body with this name, or −1.
  int find_whole(const std::string& name) const;
  /// Index into `wholes` of the whole to which a body belongs.
  int whole_of(int body) const;
};

}  // namespace buckens::model
