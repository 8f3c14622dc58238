// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/add_load.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/loads/applied_load.h"
#include "buckens/loads/coordinate_law.h"
#include "buckens/loads/rigid_law.h"
#include "buckens/loads/spring_damper.h"
#include "buckens/model/build/add_ball_friction.h"
#include "buckens/model/build/add_belt.h"
#include "buckens/model/build/add_cable.h"
#include "buckens/model/build/add_cam.h"
#include "buckens/model/build/add_contact.h"
#include "buckens/model/build/add_contacts.h"
#include "buckens/model/build/add_gear_teeth.h"
#include "buckens/model/build/find_factor.h"

namespace buckens::model {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

// Sine of the angle up to which a direction counts as lying in the plane of a planar model.
constexpr double kOutOfPlane = 1e-6;
// A rope that is shorter than the distance by this share is meant to be taut.
constexpr double kTautRope = 1e-9;

class LoadBuilder {
 public:
  explicit LoadBuilder(MarkerFinder& find) : find_(find) {}

  void add(const loads::LoadSpec& spec) {
    Load load;
    load.name = spec.name;
    load.kind = spec.kind_name();
    std::vector<Load> behind;
    if (const auto* force = std::get_if<loads::ForceSpec>(&spec.kind)) {
      add_applied(*force, loads::AppliedLoad::Kind::force, load, spec.where);
    } else if (const auto* torque = std::get_if<loads::TorqueSpec>(&spec.kind)) {
      add_applied(*torque, loads::AppliedLoad::Kind::torque, load, spec.where);
    } else if (const auto* spring = std::get_if<loads::SpringDamperSpec>(&spec.kind)) {
      add_spring(*spring, load, spec.where);
    } else if (const auto* rope = std::get_if<loads::RopeSpec>(&spec.kind)) {
      add_rope(*rope, load, spec.where);
    } else if (const auto* torsional = std::get_if<loads::TorsionalSpringSpec>(&spec.kind)) {
      add_torsional(*torsional, load, spec.where);
    } else if (const auto* contact = std::get_if<loads::ContactSpec>(&spec.kind)) {
      behind = set_contact(*contact, find_, load, spec.where);
    } else if (const auto* contacts = std::get_if<loads::ContactsSpec>(&spec.kind)) {
      set_contacts(*contacts, find_, load, spec.where);
    } else if (const auto* belt = std::get_if<loads::ElasticBeltSpec>(&spec.kind)) {
      set_belt(*belt, find_, load, spec.where);
    } else if (const auto* cable = std::get_if<loads::CableSpec>(&spec.kind)) {
      set_cable(*cable, find_, load, spec.where);
    } else if (const auto* cam = std::get_if<loads::CamSpec>(&spec.kind)) {
      set_cam(*cam, find_, load, spec.where);
    } else if (const auto* teeth = std::get_if<loads::ElasticGearSpec>(&spec.kind)) {
      set_gear_teeth(*teeth, find_, load, spec.where);
    } else if (const auto* ball = std::get_if<loads::BallFrictionSpec>(&spec.kind)) {
      behind = set_ball_friction(*ball, find_, load, spec.where);
    }
    find_.model().loads.push_back(std::move(load));
    std::move(behind.begin(), behind.end(), std::back_inserter(find_.model().loads));
  }

 private:
  /// Forces act in the plane, torques about its normal; anything else would be silently dropped.
  /// @param R_WA axes of the load; those of a marker keep their angles with the normal
  void require_in_plane(const std::array<base::TimeLaw, 3>& value, const Matrix3d& R_WA,
                        bool moment, const Load& load, const SourceLocation& where) {
    const Vector3d normal_A = R_WA.transpose() * spatial::normal(*find_.model().planar);
    const auto lost = [&](const Vector3d& v) {
      return moment ? Vector3d(v - normal_A * normal_A.dot(v)).norm() : std::abs(normal_A.dot(v));
    };
    const auto is_constant = [](const base::TimeLaw& law) { return law.is_constant(); };
    if (std::all_of(value.begin(), value.end(), is_constant)) {
      // Components across the plane may cancel.
      const Vector3d whole(value[0].value(0), value[1].value(0), value[2].value(0));
      if (lost(whole) <= kOutOfPlane * whole.norm()) return;
    }
    for (int axis = 0; axis < 3; ++axis) {
      const base::TimeLaw& law = value[static_cast<std::size_t>(axis)];
      if (lost(Vector3d::Unit(axis)) <= kOutOfPlane) continue;
      if (law.is_constant() && law.value(0) == 0.0) continue;
      throw InputError(
          where,
          fmt::format(
              "load \"{}\": in a planar model a {}; set component {} to zero, or leave "
              "`planar` out",
              load.name,
              moment ? "torque acts about the normal of the plane" : "force acts in the plane",
              "xyz"[axis]));
    }
  }

  template <class Spec>
  void add_applied(const Spec& kind, loads::AppliedLoad::Kind what, Load& load,
                   const SourceLocation& where) {
    load.unit = what == loads::AppliedLoad::Kind::torque ? "N m" : "N";
    load.first = find_.marker(kind.on, true);
    if (load.first.body == kGround) {
      throw ModelError(where, fmt::format("load \"{}\" acts on the ground, which does not move; "
                                          "apply it to a body",
                                          load.name));
    }
    const bool moment = what == loads::AppliedLoad::Kind::torque;
    if (moment || kind.axes == loads::LoadAxes::following) {
      find_.require_moment(load.first, fmt::format("load \"{}\"", load.name), where);
    }
    if (find_.model().planar) {
      const bool follows = kind.axes == loads::LoadAxes::following;
      const Matrix3d R_WA = follows ? find_.placed(load.first).R() : Matrix3d::Identity();
      require_in_plane(kind.value, R_WA, moment, load, where);
    }
    load.element = std::make_unique<loads::AppliedLoad>(
        what, kind.axes, kind.value, find_factor(find_.model(), kind.factor, load.name, where));
  }

  void add_spring(const loads::SpringDamperSpec& kind, Load& load, const SourceLocation& where) {
    load.first = find_.marker(kind.between[0], true);
    load.second = find_.marker(kind.between[1], true);
    find_.require_two_bodies(load.first, load.second, fmt::format("load \"{}\"", load.name), where);
    const double distance = (find_.placed(load.second).p - find_.placed(load.first).p).norm();
    const bool has_length = kind.length && !kind.length->is_number(0.0);
    if (distance == 0.0 && (has_length || kind.force || kind.characteristic)) {
      throw InputError(where,
                       fmt::format("load \"{}\": its markers coincide as placed, so its force "
                                   "has no direction; place them apart or use a bushing",
                                   load.name));
    }
    load.element = std::make_unique<loads::SpringDamper>(kind.stiffness, kind.damping,
                                                         kind.length.value_or(distance), kind.force,
                                                         kind.characteristic);
  }

  void add_rope(const loads::RopeSpec& kind, Load& load, const SourceLocation& where) {
    load.first = find_.marker(kind.between[0], true);
    load.second = find_.marker(kind.between[1], true);
    find_.require_two_bodies(load.first, load.second, fmt::format("load \"{}\"", load.name), where);
    const double distance = (find_.placed(load.second).p - find_.placed(load.first).p).norm();
    const double length = kind.length.value_or(distance);
    if (distance > (1.0 + kTautRope) * length || length == 0.0) {
      throw InputError(where, fmt::format("load \"{}\": its markers are {:g} m apart as placed, "
                                          "and the rope is {:g} m long; place them closer, or give "
                                          "it a `length` of at least that",
                                          load.name, distance, length));
    }
    load.coordinate = static_cast<int>(find_.model().coordinates.size());
    find_.model().coordinates.push_back(
        {-1, load.first, load.second, joints::JointCoordinate::length()});
    if (kind.stiffness) {
      load.element =
          std::make_unique<loads::CoordinateStop>(-HUGE_VAL, length, *kind.stiffness, kind.damping);
    } else {
      load.element = std::make_unique<loads::RigidStop>(
          -HUGE_VAL, length, kind.restitution.value_or(0.0),
          kind.threshold.value_or(loads::RigidStop::kAtRest * length));
    }
  }

  void add_torsional(const loads::TorsionalSpringSpec& kind, Load& load,
                     const SourceLocation& where) {
    const std::string what = fmt::format("load \"{}\"", load.name);
    load.first = find_.marker(kind.between[0], true);
    load.second = find_.marker(kind.between[1], true);
    find_.require_two_bodies(load.first, load.second, what, where);
    find_.require_moment(load.first, what, where);
    find_.require_moment(load.second, what, where);
    joints::Placement p = find_.placement(load.first, load.second);
    p.axis_F = find_.axis_or_normal(kind.axis, p.R_WF, what, where);
    find_.require_across_plane(p.R_WF * joints::unit_axis(p), "a torsional spring", what, where);
    const double free = kind.angle.number().value_or(0.0);
    if (std::abs(free) >= loads::TorsionalSpring::kLargestAngle) {
      throw InputError(where, fmt::format("{}: a torsional spring measures at most {} rad from the "
                                          "position as placed, but its free angle is {:.4g} rad",
                                          what, loads::TorsionalSpring::kLargestAngle, free));
    }
    load.element = std::make_unique<loads::TorsionalSpring>(
        joints::unit_axis(p), p.R_WF.transpose() * p.R_WM, kind.stiffness, kind.damping, kind.angle,
        kind.characteristic);
  }

  MarkerFinder& find_;
};

}  // namespace

void add_load(const loads::LoadSpec& spec, MarkerFinder& find) { LoadBuilder(find).add(spec); }

void add_own_force(const OwnForce& force, MarkerFinder& find) {
  if (!force.element) {
    throw InputError(force.where,
                     fmt::format("load \"{}\" has no force law; give it one", force.name));
  }
  Load load;
  load.name = force.name;
  load.kind = "force law";
  load.first = find.marker(force.first, true);
  load.second = find.marker(force.second, true);
  find.require_two_bodies(load.first, load.second, fmt::format("load \"{}\"", force.name),
                          force.where);
  load.element = force.element;
  find.model().loads.push_back(std::move(load));
}

}  // namespace buckens::model
