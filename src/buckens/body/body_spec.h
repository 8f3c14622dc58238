// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Geometry>

#include "buckens/base/field.h"
#include "buckens/body/coupling_level.h"
#include "buckens/body/frame_division.h"
#include "buckens/body/reduction_spec.h"
#include "buckens/body/solver_spec.h"
#include "buckens/fem/assembly/matrices_spec.h"
#include "buckens/fem/mesh/region_spec.h"
#include "buckens/fem/mesh/spec.h"
#include "buckens/fem/structure_spec.h"

namespace buckens::body {

/// Orientation in one of three forms.
struct OrientationSpec {
  SourceLocation where;
  std::optional<Eigen::Vector3d> axis;
  std::optional<double> angle;                      ///< about the axis [rad]
  std::optional<Eigen::Vector3d> euler;             ///< [rad]
  std::optional<std::array<double, 4>> quaternion;  ///< w, x, y, z

  /// R = Rx(α) Ry(β) Rz(γ) for Euler angles: each rotation about the already rotated axes.
  Eigen::Quaterniond rotation() const {
    using Eigen::AngleAxisd, Eigen::Quaterniond, Eigen::Vector3d;
    if (axis && angle) return Quaterniond(AngleAxisd(*angle, axis->normalized()));
    if (euler) {
      return Quaterniond(AngleAxisd(euler->x(), Vector3d::UnitX()) *
                         AngleAxisd(euler->y(), Vector3d::UnitY()) *
                         AngleAxisd(euler->z(), Vector3d::UnitZ()));
    }
    if (quaternion) {
      const auto& q = *quaternion;
      return Quaterniond(q[0], q[1], q[2], q[3]).normalized();
    }
    return Quaterniond::Identity();
  }

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("axis", axis, "axis of the rotation by `angle`").like("[0, 0, 1]"));
    visit(base::field("angle", angle, "angle about `axis`").in(base::kAngle).like("30 deg"));
    visit(base::field("euler", euler, "rotations about x, then the rotated y, then the rotated z")
              .in(base::kAngle)
              .like("[0, 0, 90 deg]"));
    visit(base::field("quaternion", quaternion, "[w, x, y, z]; normalised").like("[1, 0, 0, 0]"));
  }
};

/// Pose of the model axes of a body in the world at t = 0.
struct PlacementSpec {
  SourceLocation where;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< of the origin of the model axes [m]
  std::optional<OrientationSpec> orientation;

  Eigen::Quaterniond rotation() const {
    return orientation ? orientation->rotation() : Eigen::Quaterniond::Identity();
  }

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("position", position, "origin of the model axes in the world")
              .in(base::kLength)
              .like("[150 mm, 0, 0]"));
    visit(base::field("orientation", orientation, "orientation of the model axes in the world")
              .like("{axis: [0, 0, 1], angle: 30 deg}")
              .otherwise("parallel to the world"));
  }
};

/// A named point with axes on a body. Exactly one of position and at is given.
struct MarkerSpec {
  std::string name;
  SourceLocation where;
  std::optional<Eigen::Vector3d> position;  ///< model axes [m]
  std::string at;                           ///< origin, com, start, mid, end or a node
  std::optional<OrientationSpec> orientation;

  Eigen::Quaterniond rotation() const {
    return orientation ? orientation->rotation() : Eigen::Quaterniond::Identity();
  }

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(
        base::field(
            "position", position,
            "position in model axes; on a flexible body it must be on a beam or bar, or at a node")
            .in(base::kLength)
            .like("[100 mm, 0, 0]")
            .otherwise("give this or `at`"));
    visit(base::field("at", at, "origin, com, start, mid, end (beams) or the name of a node")
              .like("end")
              .otherwise("give this or `position`"));
    visit(base::field("orientation", orientation, "orientation of the marker in model axes")
              .like("{axis: [0, 0, 1], angle: 30 deg}")
              .otherwise("parallel to the model axes"));
  }
};

/// How the nodes of an interface follow its frame.
enum class InterfaceKind {
  average,  ///< the frame follows the mean motion of the nodes, which stay free to deform
  rigid,    ///< the nodes move as a rigid body with the frame
};

constexpr std::array<const char*, 2> choice_names(InterfaceKind) { return {"average", "rigid"}; }

/// A region of a solid mesh with a frame that can be used like a marker.
struct InterfaceSpec {
  std::string name;
  SourceLocation where;
  fem::RegionSpec region;
  InterfaceKind kind = InterfaceKind::average;
  std::optional<Eigen::Vector3d> at;  ///< model axes [m]
  std::optional<OrientationSpec> orientation;

  Eigen::Quaterniond rotation() const {
    return orientation ? orientation->rotation() : Eigen::Quaterniond::Identity();
  }

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::inlined(region, "which nodes belong to it").required());
    visit(
        base::field("kind", kind,
                    "average: the frame follows the mean displacement and rotation of the nodes "
                    "and distributes its forces over them; rigid: the nodes move as a rigid body"));
    visit(base::field("at", at, "place of the frame in model axes")
              .in(base::kLength)
              .like("[0, 0, 0]")
              .otherwise("the centre of the region"));
    visit(base::field("orientation", orientation, "orientation of the frame in model axes")
              .like("{axis: [0, 0, 1], angle: 30 deg}")
              .otherwise("parallel to the model axes"));
  }
};

/// Rigid body given by its mass properties.
struct RigidSpec {
  static constexpr const char* kKey = "rigid";
  static constexpr const char* kDoc = "rigid body, given by its mass properties";
  SourceLocation where;
  double mass = 0;                                ///< [kg]
  Eigen::Vector3d com = Eigen::Vector3d::Zero();  ///< model axes [m]
  /// Ixx, Iyy, Izz and optionally Ixy, Ixz, Iyz about the mass centre, in model axes [kg m²].
  std::vector<double> inertia;

  Eigen::Matrix3d inertia_matrix() const { return fem::symmetric_matrix(inertia); }

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("mass", mass, "mass")
              .in(base::kMass)
              .required()
              .non_negative()
              .like("0.36 kg"));
    visit(base::field("com", com, "mass centre in model axes")
              .in(base::kLength)
              .like("[75 mm, 0, 0]"));
    visit(
        base::field("inertia", inertia,
                    "[Ixx, Iyy, Izz] or [Ixx, Iyy, Izz, Ixy, Ixz, Iyz] about the "
                    "mass centre, in model axes; Ixy = -∫ x y dm")
            .in(base::kInertia)
            .like("[0, 0, 2.727e-3 kg m^2]")
            .otherwise("a point mass, which rotates only with a joint away from its mass centre"));
  }
};

/// A body with the mesh or mass properties of another body.
struct LikeSpec {
  static constexpr const char* kKey = "like";
  static constexpr const char* kDoc =
      "mesh or mass properties, markers and damping of a body defined above; with its own "
      "position, "
      "coupling and solver";
  SourceLocation where;
  std::string body;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("body", body, "name of the other body")
              .required()
              .shorthand()
              .like("left_arm"));
  }
};

constexpr std::array<const char*, 8> choice_names(CouplingLevel) {
  return {"full", "first-order", "none", "auto", "noquad", "nocent", "nocor", "nojvar"};
}
constexpr std::array<const char*, 7> choice_names(CouplingTerm) {
  return {"quad-ref", "jvar", "cor-ref", "cent0", "cent1", "cor-fe", "eul-fe"};
}

/// Inertial coupling of elastic and frame motion.
struct CouplingSpec {
  SourceLocation where;
  CouplingLevel level = CouplingLevel::full;
  std::vector<CouplingTerm> drop;
  double tolerance = 0.01;

  CouplingChoice choice() const { return {level, drop, tolerance}; }

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("level", level,
                      "full, first-order and none derive from a kinetic energy; auto moves up "
                      "among them during the run; the others leave out single groups of terms")
              .shorthand()
              .like("first-order"));
    visit(base::field("drop", drop, "further terms to leave out, to study their effect")
              .like("[cent0, cent1]")
              .otherwise("none"));
    visit(base::field("tolerance", tolerance,
                      "auto: largest admissible share of the neglected terms in all inertial, "
                      "elastic and applied loads of the mesh")
              .positive()
              .like("1 %"));
  }
};

/// A rigid or flexible body.
struct BodySpec {
  // In body_spec.cpp, because they reach through all members: two to five seconds of compiling
  // each.
  BodySpec();
  BodySpec(const BodySpec&);
  BodySpec(BodySpec&&) noexcept;
  BodySpec& operator=(const BodySpec&);
  BodySpec& operator=(BodySpec&&) noexcept;
  ~BodySpec();

  std::string name;
  SourceLocation where;
  /// Contents of the body. The reader replaces LikeSpec by the contents of the other body; `like`
  /// then holds the name of that body.
  std::variant<RigidSpec, fem::BeamSpec, fem::StructureSpec, fem::MeshSpec, fem::GeometrySpec,
               fem::MatricesSpec, LikeSpec>
      kind;
  std::string like;
  PlacementSpec at;
  std::vector<MarkerSpec> markers;
  std::vector<InterfaceSpec> interfaces;
  FrameDivision frames;
  CouplingSpec coupling;
  ReductionSpec reduction;
  SolverSpec solver;
  Flexibility flexibility = Flexibility::elastic;
  bool geometric_stiffness = false;
  std::optional<fem::DampingSpec> damping;  ///< in place of that of the materials

  bool is_rigid() const { return std::holds_alternative<RigidSpec>(kind); }

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::inlined(kind, "what the body is made of").required());
    visit(
        base::field("at", at, "position and orientation of the model axes in the world at t = 0"));
    visit(base::field("markers", markers, "named points for joints, loads and sensors")
              .like("{pin: {position: [100 mm, 0, 0]}}"));
    visit(base::field("interfaces", interfaces,
                      "regions of a mesh of solids that joints, loads and sensors use like markers")
              .like("{bearing: {face: x0}}"));
    visit(base::field("frames", frames,
                      "number of body frames that carry the mesh, each one part of it")
              .positive()
              .like("8"));
    visit(base::field("coupling", coupling, "inertial coupling of elastic and frame motion")
              .like("first-order")
              .otherwise("full"));
    visit(base::field("reduction", reduction, "reduced basis of the mesh")
              .like("{free-free: 8}")
              .otherwise("none"));
    visit(base::field("solver", solver, "how the large systems of the mesh are solved")
              .like("iterative")
              .otherwise("direct"));
    visit(base::field("flexibility", flexibility,
                      "elastic, or quasi-static: the body moves like a rigid body of deformed "
                      "shape and deforms under the loads of that motion without vibrating"));
    visit(base::field("geometric-stiffness", geometric_stiffness,
                      "axial forces of beams and bars stiffen or soften their bending within a "
                      "frame; approximate and not energy-conserving; `frames` is exact")
              .on_off());
    visit(base::field("damping", damping, "Rayleigh damping, overrides that of the materials")
              .otherwise("that of the materials"));
  }
};

}  // namespace buckens::body
