// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>

#include "buckens/base/coordinate_choice.h"
#include "buckens/base/expression.h"
#include "buckens/base/field.h"
#include "buckens/model/spec/rest_friction.h"

namespace buckens::model {

/// A value that varies over a body: a formula in x, y, z (model axes of the body, metres).
struct PositionLaw {
  base::Expression expression;
  double scale = 1;  ///< SI value of the formula's unit
  bool given = false;

  double operator()(const Eigen::Vector3d& p) const {
    return given ? scale * expression({p.x(), p.y(), p.z()}) : 0.0;
  }
};

/// Velocities of the nodal variables relative to the body frame, in model axes. Any rigid motion is
/// sieved out.
struct NodalVelocitySpec {
  SourceLocation where;
  PositionLaw x, y, z;     ///< [m/s]
  PositionLaw rx, ry, rz;  ///< [rad/s]

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("x", x, "velocity along model x")
              .in(base::kVelocity)
              .like("\"0.1*sin(pi*x) m/s\""));
    visit(base::field("y", y, "velocity along model y").in(base::kVelocity));
    visit(base::field("z", z, "velocity along model z").in(base::kVelocity));
    visit(base::field("rx", rx, "rate of rotation about model x").in(base::kAngularVelocity));
    visit(base::field("ry", ry, "rate of rotation about model y").in(base::kAngularVelocity));
    visit(base::field("rz", rz, "rate of rotation about model z").in(base::kAngularVelocity));
  }
};

/// Displacements of the nodal variables relative to the body frame, in model axes. Any rigid motion
/// is sieved out.
struct NodalDisplacementSpec {
  SourceLocation where;
  PositionLaw x, y, z;     ///< [m]
  PositionLaw rx, ry, rz;  ///< [rad]

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("x", x, "displacement along model x")
              .in(base::kLength)
              .like("\"0.1*sin(pi*x) mm\""));
    visit(base::field("y", y, "displacement along model y").in(base::kLength));
    visit(base::field("z", z, "displacement along model z").in(base::kLength));
    visit(base::field("rx", rx,
                      "rotation about model x; beams and shells have their own rotations, which "
                      "must match the slope of the displacements")
              .in(base::kAngle));
    visit(base::field("ry", ry, "rotation about model y").in(base::kAngle));
    visit(base::field("rz", rz, "rotation about model z").in(base::kAngle));
  }
};

/// Motion of one body at t = 0.
struct InitialBodySpec {
  std::string name;  ///< of the body
  SourceLocation where;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();          ///< of the mass centre, world [m/s]
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();  ///< model axes [rad/s]
  std::optional<NodalVelocitySpec> nodal_velocity;
  std::optional<NodalDisplacementSpec> nodal_displacement;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("velocity", velocity, "velocity of the mass centre, world axes")
              .in(base::kVelocity)
              .like("[1 m/s, 0, 0]"));
    visit(base::field("angular-velocity", angular_velocity,
                      "angular velocity, in the body's model axes")
              .in(base::kAngularVelocity)
              .like("[0, 0, 60 rpm]"));
    visit(
        base::field("nodal-velocity", nodal_velocity,
                    "velocity of the nodes relative to the body "
                    "frame: formulas in the model coordinates x, y, z [m]; rigid motion is removed")
            .otherwise("none"));
    visit(base::field("nodal-displacement", nodal_displacement,
                      "shape in which the body starts: displacement of the nodes relative to the "
                      "body frame, formulas in the model coordinates x, y, z [m]; rigid motion is "
                      "removed, and frames move as far as the joints require")
              .otherwise("undeformed"));
  }
};

/// Initial values of the coordinates of a joint, in the order of base::kCoordinateNames.
struct InitialJointSpec {
  std::string name;  ///< of the joint
  SourceLocation where;
  std::array<std::optional<double>, base::kNumCoordinateChoices> values;  ///< [rad] or [m]
  std::array<std::optional<double>, base::kNumCoordinateChoices> rates;   ///< [rad/s] or [m/s]

  const std::optional<double>& value(base::CoordinateChoice which) const {
    return values[static_cast<std::size_t>(which)];
  }
  /// The key that specifies a coordinate; null: none does.
  const char* key_of(const base::CoordinateName& own) const {
    const auto k = static_cast<std::size_t>(own.which);
    return values[k] ? own.key : rates[k] ? own.rate_key : nullptr;
  }

  template <class Visitor>
  void fields(Visitor& visit) {
    static constexpr std::array<const char*, base::kNumCoordinateChoices> kDocs = {
        "of a joint that turns, counted from the position as placed and over turns",
        "of a joint that slides, counted from the position as placed",
        "of a universal joint: about the arm that its second body holds",
        "displacement along x of a plane, or of a joint that leaves all translations free",
        "displacement along y of a plane, or of a joint that leaves all translations free",
        "displacement along z of a joint that leaves all translations free",
        "angle between the axes of a ball joint, or of shafts of constant velocity",
        "of a ball joint: turn about the axis of its second body"};
    for (const base::CoordinateName& own : base::kCoordinateNames) {
      const auto k = static_cast<std::size_t>(own.which);
      visit(base::field(own.key, values[k], kDocs[k])
                .in(own.is_angle ? base::kAngle : base::kLength)
                .like(own.is_angle ? "30 deg" : "20 mm")
                .otherwise("as placed, or as other joints ask for"));
      visit(base::field(own.rate_key, rates[k],
                        base::lasting_text(fmt::format("rate of `{}`", own.key)))
                .in(own.is_angle ? base::kAngularVelocity : base::kVelocity)
                .like(own.is_angle ? "2 rad/s" : "0.1 m/s")
                .otherwise("as the velocities of bodies ask for"));
    }
  }
};

enum class StartKind { as_given, static_equilibrium };

constexpr std::array<const char*, 2> choice_names(StartKind) { return {"as-given", "static"}; }

/// Initial conditions of the motion.
struct InitialSpec {
  SourceLocation where;
  std::vector<InitialBodySpec> bodies;
  std::vector<InitialJointSpec> joints;
  StartKind start = StartKind::as_given;
  RestFriction friction = RestFriction::free;
  std::vector<std::string> off;       ///< loads
  std::vector<std::string> released;  ///< joints
  bool preload = false;               ///< accept bodies that must be deformed to fit together

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("bodies", bodies, "initial velocities and shapes by name of the body"));
    visit(base::field("joints", joints,
                      "coordinates and their rates by name of the joint; assembly holds "
                      "them while it moves all else as little as it can")
              .like("{elbow: {angle: 30 deg, speed: 2 rad/s}}"));
    visit(base::field("start", start,
                      "`static` starts in equilibrium under gravity and constant loads"));
    visit(
        base::field("friction", friction,
                    "in the static equilibrium, also that of `modes --about static`: `free` "
                    "neglects friction; `frozen` holds what rubs, joints, brakes and "
                    "contacts, where it is, and warns where that takes more than friction gives"));
    visit(base::field("off", off, "loads that do not act until an event switches them on")
              .like("[brake]"));
    visit(base::field("released", released, "joints that hold nothing until an event attaches them")
              .like("[gripper]"));
    visit(base::field("preload", preload, "accept bodies that must be deformed to fit together"));
  }
};

}  // namespace buckens::model
