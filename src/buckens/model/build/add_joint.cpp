// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/add_joint.h"

#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/loads/bushing.h"
#include "buckens/model/build/add_coupler.h"
#include "buckens/model/build/add_gear_teeth.h"
#include "buckens/model/build/add_slider.h"
#include "buckens/model/build/curve_of_path.h"

namespace buckens::model {

namespace {

// Sine of the angle up to which the axis of a drive is that of an arm.
constexpr double kAlongArm = 1e-4;

/// Whether both are the same marker, or the same frame of the ground.
bool are_one(const MarkerId& a, const MarkerId& b) {
  if (a.body != b.body) return false;
  if (a.body != kGround) return a.marker == b.marker;
  return a.X_WF.p == b.X_WF.p && a.X_WF.q.coeffs() == b.X_WF.q.coeffs();
}

class JointBuilder {
 public:
  explicit JointBuilder(MarkerFinder& find) : find_(find) {}

  void add(const joints::JointSpec& spec) {
    using joints::JointType;
    struct Adder {
      JointBuilder& b;
      const joints::JointSpec& spec;
      void operator()(const joints::RevoluteSpec& k) { b.add_rows(JointType::revolute, k, spec); }
      void operator()(const joints::SphericalSpec& k) { b.add_rows(JointType::spherical, k, spec); }
      void operator()(const joints::PrismaticSpec& k) { b.add_rows(JointType::prismatic, k, spec); }
      void operator()(const joints::FixedSpec& k) { b.add_rows(JointType::fixed, k, spec); }
      void operator()(const joints::BushingSpec& k) { b.add_bushing(k, spec); }
      void operator()(const joints::PrescribedRotationSpec& k) {
        b.add_rows(JointType::prescribed_rotation, k, spec);
      }
      void operator()(const joints::PrescribedTranslationSpec& k) {
        b.add_rows(JointType::prescribed_translation, k, spec);
      }
      void operator()(const joints::CylindricalSpec& k) {
        b.add_rows(JointType::cylindrical, k, spec);
      }
      void operator()(const joints::PlanarJointSpec& k) { b.add_rows(JointType::planar, k, spec); }
      void operator()(const joints::UniversalSpec& k) { b.add_rows(JointType::universal, k, spec); }
      void operator()(const joints::ConstantVelocitySpec& k) {
        b.add_rows(JointType::constant_velocity, k, spec);
      }
      void operator()(const joints::PointOnLineSpec& k) {
        b.add_rows(JointType::point_on_line, k, spec);
      }
      void operator()(const joints::PointInPlaneSpec& k) {
        b.add_rows(JointType::point_in_plane, k, spec);
      }
      void operator()(const joints::ParallelSpec& k) { b.add_rows(JointType::parallel, k, spec); }
      void operator()(const joints::OrientationSpec& k) {
        b.add_rows(JointType::orientation, k, spec);
      }
      void operator()(const joints::DistanceSpec& k) { b.add_rows(JointType::distance, k, spec); }
      void operator()(const joints::ScrewSpec& k) { b.add_rows(JointType::screw, k, spec); }
      void operator()(const joints::GearSpec& k) { b.add_rows(JointType::gear, k, spec); }
      void operator()(const joints::RackSpec& k) { b.add_rows(JointType::rack, k, spec); }
      void operator()(const joints::BeltSpec& k) { b.add_rows(JointType::belt, k, spec); }
      void operator()(const joints::SlotSpec& k) { b.add_rows(JointType::slot, k, spec); }
      void operator()(const joints::SliderOnBeamSpec&) { add_slider(spec, b.find_); }
      void operator()(const joints::RollingSpec& k) { b.add_rows(JointType::rolling, k, spec); }
      void operator()(const joints::CouplerSpec&) { add_coupler(spec, b.find_); }
      void operator()(const joints::PrescribedCoordinateSpec&) {
        add_coordinate_drive(spec, b.find_);
      }
    };
    std::visit(Adder{*this, spec}, spec.kind);
  }

 private:
  template <class Spec>
  void add_rows(joints::JointType type, const Spec& kind, const joints::JointSpec& spec) {
    const std::string what = fmt::format("joint \"{}\"", spec.name);
    Joint joint;
    joint.name = spec.name;
    joint.type = type;
    joint.first = find_.marker(kind.between[0], true);
    joint.second = find_.marker(kind.between[1], true);
    find_.require_two_bodies(joint.first, joint.second, what, spec.where);
    joints::Placement placement = find_.placement(joint.first, joint.second);
    if constexpr (requires { kind.axis; }) {
      placement.axis_F = find_.axis_or_normal(kind.axis, placement.R_WF, what, spec.where);
    }
    if constexpr (requires { kind.laws(); }) {
      // Those that follow signals get them when these are known, see add_drives().
      placement.law = kind.laws().is_steered() ? base::TimeLaw() : kind.laws().of_time();
    }
    if constexpr (requires { kind.second_axis; }) placement.second_axis_F = kind.second_axis;
    if constexpr (requires { kind.moved_axis; }) {
      placement.axis_F = kind.held_axis.value_or(Eigen::Vector3d::UnitZ());
      placement.second_axis_F = kind.moved_axis;
    }
    if constexpr (requires { kind.x_axis; }) placement.x_F = kind.x_axis;
    if constexpr (requires { kind.length; }) placement.length = kind.length;
    if constexpr (requires { kind.pitch; }) placement.pitch = kind.pitch;
    place_teeth(kind, placement);
    if constexpr (requires { kind.as_found; }) placement.as_found = kind.as_found;
    if constexpr (requires { kind.laws(); }) {
      if (type == joints::JointType::prescribed_rotation) place_mark(joint, what, spec, placement);
    }
    try {
      joint.axis_F = joints::unit_axis(placement);
      joint.rows = joints::make_rows(type, placement);
      joint.coordinates = joints::make_coordinates(type, spec.coordinates(), placement, joint.rows);
      if (type == joints::JointType::universal) joint.arm_F = placement.second_axis_F->normalized();
      if (type == joints::JointType::rolling) joint.axis_F = axle_M(placement);
      if (type == joints::JointType::belt) {
        joint.pulleys = {placement.sizes[0],
                         placement.same_sense ? placement.sizes[1] : -placement.sizes[1]};
      }
    } catch (const ModelError& error) {
      throw ModelError(spec.where, fmt::format("{}: {}", what, error.what()));
    }
    for (const joints::ConstraintRow& row : joint.rows) {
      if (row.turns_first()) find_.require_moment(joint.first, what, spec.where);
      if (row.turns_second()) find_.require_moment(joint.second, what, spec.where);
    }
    if constexpr (requires { kind.backlash; }) {
      if (kind.backlash > 0.0) return add_teeth(kind, joint, placement, spec);
    }
    joint.where = spec.where;
    joint.first_row = find_.model().num_constraint_rows();
    find_.model().joints.push_back(std::move(joint));
  }

  void add_teeth(const joints::ToothPlay& play, const Joint& joint,
                 const joints::Placement& placement, const joints::JointSpec& spec) {
    try {
      add_flanks(play, joint, placement, find_.model());
    } catch (const ModelError& error) {
      throw ModelError(spec.where, fmt::format("joint \"{}\": {}", spec.name, error.what()));
    }
  }

  /// A drive between the markers of a cross joint counts the angle about the arm of its first
  /// marker by where the other arm is: nothing else stays across this axis.
  void place_mark(const Joint& drive, const std::string& what, const joints::JointSpec& spec,
                  joints::Placement& placement) {
    for (const Joint& cross : find_.model().joints) {
      if (cross.type != joints::JointType::universal) continue;
      const bool is_same = are_one(cross.first, drive.first) && are_one(cross.second, drive.second);
      const bool is_swapped =
          are_one(cross.first, drive.second) && are_one(cross.second, drive.first);
      if (!is_same && !is_swapped) continue;
      const Eigen::Matrix3d R_FC = placement.R_WF.transpose() * find_.placed(cross.first).R();
      const Eigen::Vector3d own = R_FC * (is_same ? cross.axis_F : cross.arm_F);
      const Eigen::Vector3d other = R_FC * (is_same ? cross.arm_F : cross.axis_F);
      const Eigen::Vector3d axis = joints::unit_axis(placement);
      if (axis.cross(own).norm() <= kAlongArm) placement.mark_F = other;
      if (axis.cross(other).norm() > kAlongArm) continue;
      throw ModelError(
          spec.where,
          fmt::format("{}: its axis is the arm of joint \"{}\" that is fixed to the second marker, "
                      "but an axis must be fixed to the first; swap the markers of `between`",
                      what, cross.name));
    }
  }

  /// Axis of a wheel in its own marker.
  static Eigen::Vector3d axle_M(const joints::Placement& p) {
    const Eigen::Vector3d in_W =
        p.planar ? spatial::normal(*p.planar) : Eigen::Vector3d(p.R_WF * *p.second_axis_F);
    return (p.R_WM.transpose() * in_W).normalized();
  }

  /// What gears, racks, belts, slots and wheels say beside markers and axis.
  template <class Spec>
  static void place_teeth(const Spec& kind, joints::Placement& placement) {
    if constexpr (requires { kind.pressure_angle; }) {
      placement.pressure_angle = kind.pressure_angle;
      placement.helix_angle = kind.helix_angle;
    }
    if constexpr (requires { kind.teeth; }) {
      placement.sizes = kind.teeth;
      placement.same_sense = kind.internal;
    }
    if constexpr (requires { kind.path; }) {
      placement.path = kind.path;
      placement.path_start = kind.start.value_or(Eigen::Vector3d::Zero());
      placement.path_steps = curve_steps(kind);
      placement.is_closed = kind.closed;
      placement.path_normal_F = kind.normal;
    }
    if constexpr (requires { kind.radii; }) {
      placement.sizes = kind.radii;
      placement.same_sense = !kind.crossed;
    }
    if constexpr (requires { kind.wheel_radius; }) {
      placement.axis_F = kind.normal;
      placement.sizes = {kind.wheel_radius, kind.wheel_radius};
      placement.edge = kind.edge;
      if (kind.axle) {
        placement.second_axis_F = placement.R_WF.transpose() * (placement.R_WM * *kind.axle);
      }
    }
    if constexpr (requires { kind.radius; }) {
      placement.sizes = {kind.radius, kind.radius};
      placement.second_axis_F = kind.along;
    }
  }

  void add_bushing(const joints::BushingSpec& kind, const joints::JointSpec& spec) {
    const std::string what = fmt::format("joint \"{}\"", spec.name);
    Load load;
    load.name = spec.name;
    load.first = find_.marker(kind.between[0], true);
    load.second = find_.marker(kind.between[1], true);
    find_.require_two_bodies(load.first, load.second, what, spec.where);
    find_.require_moment(load.first, what, spec.where);
    find_.require_moment(load.second, what, spec.where);
    const joints::Placement p = find_.placement(load.first, load.second);
    load.element = std::make_unique<loads::Bushing>(
        loads::Bushing::Coefficients{kind.stiffness, kind.rotational_stiffness, kind.damping,
                                     kind.rotational_damping, kind.forces, kind.torques,
                                     kind.stiffness_factor, kind.damping_factor},
        p.R_WF.transpose() * p.R_WM, p.r_F);
    load.kind = joints::BushingSpec::kKey;
    load.is_among_joints = true;
    find_.model().loads.push_back(std::move(load));
  }

  MarkerFinder& find_;
};

}  // namespace

void add_joint(const joints::JointSpec& spec, MarkerFinder& find) { JointBuilder(find).add(spec); }

}  // namespace buckens::model
