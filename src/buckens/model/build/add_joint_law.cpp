// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/add_joint_law.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/loads/bristle_friction.h"
#include "buckens/loads/coordinate_curve.h"
#include "buckens/loads/coordinate_law.h"
#include "buckens/loads/coordinate_motor.h"
#include "buckens/loads/joint_friction.h"
#include "buckens/loads/rigid_law.h"
#include "buckens/model/build/friction_laws.h"
#include "buckens/spatial/principal_axes.h"

namespace buckens::model {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

// Elastic slip before friction breaks away: of the model's length, and as an angle.
constexpr double kSlip = 1e-6;
constexpr double kSlipOfHinge = 1e-5;
// Rotary inertia below this share of m L² is none.
constexpr double kNoInertia = 1e-12;

/// Inertia that a force along a coordinate moves, with both bodies free of all else [kg], [kg m²].
double moved_inertia(const Model& model, const Coordinate& coordinate, MarkerFinder& find) {
  const Joint& joint = model.joints[static_cast<std::size_t>(coordinate.joint)];
  const auto motion = [&](const MarkerId& id) {
    const spatial::Pose X = find.placed(id);
    spatial::MarkerMotion out;
    out.p = X.p;
    out.R = X.R();
    return out;
  };
  spatial::MarkerMotion first = motion(joint.first);
  const spatial::MarkerMotion second = motion(joint.second);
  if (joint.track) {
    const auto node = [&](std::size_t k) { return motion(joint.track->nodes[k]); };
    const joints::TrackPoint at = joint.track->shape.at(joint.track->placed, node);
    first.p = at.p;
    first.R << at.tangent.normalized(), at.across(0), at.across(1);
  }
  const spatial::PairRow J = coordinate.law.derivatives(first, second);
  double inverse = 0.0;
  const auto add = [&](const MarkerId& id, const Vector3d& place, const Vector3d& torque,
                       const Vector3d& force) {
    if (id.body == kGround) return;
    const auto b = static_cast<std::size_t>(id.body);
    const body::Body& body = model.bodies[b];
    inverse += force.squaredNorm() / body.mass;
    const Matrix3d R = model.placed[b].R();
    const Vector3d arm = place - model.placed[b].p;
    const Vector3d moment = R.transpose() * (torque + arm.cross(force));
    const spatial::PrincipalAxes principal = spatial::principal_axes(body.J0);
    for (int k = 0; k < 3; ++k) {
      const double own = principal.values[k];
      if (own <= kNoInertia * body.mass * arm.squaredNorm() || own <= 0.0) continue;
      inverse += std::pow(principal.vectors.col(k).dot(moment), 2) / own;
    }
  };
  add(joint.first, first.p, J.segment<3>(0).transpose(), J.segment<3>(3).transpose());
  add(joint.second, second.p, J.segment<3>(6).transpose(), J.segment<3>(9).transpose());
  return inverse > 0.0 ? 1.0 / inverse : 0.0;
}

class JointLawBuilder {
 public:
  JointLawBuilder(const loads::LoadSpec& spec, MarkerFinder& find, double length)
      : spec_(spec), find_(find), length_(length) {}

  template <class Spec>
  void add(const Spec& kind) {
    Model& model = find_.model();
    const int index = find_coordinate(
        kind.joint, kind.which,
        Spec::kTurns ? base::CoordinateSort::angles : base::CoordinateSort::displacements, find_);
    if (index < 0) {
      throw ModelError(spec_.where, fmt::format("load \"{}\": there is no joint \"{}\"", spec_.name,
                                                kind.joint));
    }
    const Coordinate& coordinate = model.coordinates[static_cast<std::size_t>(index)];
    const Joint& joint = model.joints[static_cast<std::size_t>(coordinate.joint)];
    const std::string what = fmt::format("load \"{}\"", spec_.name);
    find_.require_moment(joint.first, what, spec_.where);
    if (Spec::kTurns) find_.require_moment(joint.second, what, spec_.where);
    Load load;
    load.name = spec_.name;
    load.kind = Spec::kKey;
    load.first = joint.first;
    load.second = joint.second;
    load.coordinate = index;
    load.joint = coordinate.joint;
    load.element = make(kind, coordinate);
    model.loads.push_back(std::move(load));
  }

 private:
  using Element = std::shared_ptr<const loads::ForceElement>;

  static Element make(const loads::HingeSpringSpec& kind, const Coordinate&) {
    return make_spring(kind, kind.angle);
  }
  static Element make(const loads::SlideSpringSpec& kind, const Coordinate&) {
    return make_spring(kind, kind.displacement);
  }
  template <class Spec>
  static Element make_spring(const Spec& kind, const base::SignalLaw& free) {
    if (kind.characteristic) {
      return std::make_shared<loads::CoordinateCurve>(kind.stiffness, kind.damping, free,
                                                      *kind.characteristic);
    }
    return std::make_shared<loads::CoordinateSpring>(kind.stiffness, kind.damping, free);
  }
  static Element make(const loads::MotorSpec& kind, const Coordinate&) {
    if (kind.is_exact()) {
      loads::ServoData servo;
      servo.position = kind.position;
      servo.speed = kind.speed;
      servo.return_time = kind.return_time.value_or(0.0);
      servo.limit = kind.limit.value_or(HUGE_VAL);
      servo.power = kind.power.value_or(HUGE_VAL);
      return std::make_shared<loads::CoordinateServo>(std::move(servo));
    }
    loads::MotorData data;
    data.force = kind.force;
    data.position = kind.position;
    data.speed = kind.speed;
    data.stiffness = kind.stiffness;
    data.damping = kind.damping;
    data.limit = kind.limit.value_or(HUGE_VAL);
    data.power = kind.power.value_or(HUGE_VAL);
    return std::make_shared<loads::CoordinateMotor>(std::move(data));
  }
  static Element make(const loads::BrakeSpec& kind, const Coordinate&) {
    return std::make_shared<loads::CoordinateBrake>(kind.bound);
  }
  Element make(const loads::JointStop& kind, const Coordinate& coordinate) const {
    const double from = kind.from.value_or(-HUGE_VAL);
    const double to = kind.to.value_or(HUGE_VAL);
    if (kind.stiffness) {
      return std::make_shared<loads::CoordinateStop>(from, to, *kind.stiffness, kind.damping);
    }
    const bool turns = coordinate.law.is_angle();
    const double threshold =
        kind.threshold.value_or(loads::RigidStop::kAtRest * (turns ? 1.0 : length_));
    return std::make_shared<loads::RigidStop>(from, to, kind.restitution.value_or(0.0), threshold);
  }
  loads::FrictionData common(const loads::JointFrictionBase& kind,
                             const Coordinate& coordinate) const {
    loads::FrictionData out;
    out.stribeck_rate = kind.stribeck.value_or(0.0);
    out.bearing_length = kind.length.value_or(0.0);
    out.inertia = moved_inertia(find_.model(), coordinate, find_);
    return out;
  }
  Element make(const loads::HingeFrictionSpec& kind, const Coordinate& coordinate) const {
    loads::FrictionData data = common(kind, coordinate);
    data.slip = kind.slip.value_or(kSlipOfHinge);
    data.radius = kind.radius;
    data.axial_radius = kind.axial_radius;
    return friction(kind, data, coordinate);
  }
  Element make(const loads::SlideFrictionSpec& kind, const Coordinate& coordinate) const {
    loads::FrictionData data = common(kind, coordinate);
    data.slip = kind.slip.value_or(kSlip * length_);
    data.radius = 1.0;
    data.torque_radius = kind.torque_radius.value_or(0.0);
    return friction(kind, data, coordinate);
  }
  static Element friction(const loads::JointFrictionBase& kind, const loads::FrictionData& data,
                          const Coordinate& coordinate) {
    if (kind.stick == loads::FrictionStick::rigid) {
      return std::make_shared<loads::RigidFriction>(data, coordinate.law.axis(),
                                                    friction_laws(kind));
    }
    if (kind.stick == loads::FrictionStick::bristles) {
      const loads::BristleData bristles{*kind.bristle_stiffness, kind.bristle_damping.value_or(0.0),
                                        kind.elastic_share};
      return std::make_shared<loads::BristleFriction>(data, bristles, coordinate.law.axis(),
                                                      friction_laws(kind));
    }
    return std::make_shared<loads::JointFriction>(data, coordinate.law.axis(), friction_laws(kind));
  }

  const loads::LoadSpec& spec_;
  MarkerFinder& find_;
  double length_;
};

/// The joint of this name, ties apart; −1 if there is none.
int find_joint(const Model& model, const std::string& name) {
  const auto owner = std::find_if(model.joints.begin(), model.joints.end(),
                                  [&](const Joint& j) { return j.name == name && !j.is_tie; });
  return owner == model.joints.end() ? -1 : static_cast<int>(owner - model.joints.begin());
}

/// What the check of the description has let pass: a planar model holds this coordinate.
[[noreturn]] void refuse_in_plane(const Joint& joint, base::CoordinateChoice which) {
  std::vector<std::string> others;
  for (const joints::NamedCoordinate& own : joint.coordinates) {
    others.push_back(fmt::format("`{}`", base::name_of(own.which).key));
  }
  throw ModelError(
      joint.where,
      fmt::format("joint \"{}\" is a {}, which has no `{}` in a planar model; {}, or leave "
                  "`planar` out",
                  joint.name, joints::to_string(joint.type), base::name_of(which).key,
                  others.empty() ? std::string("use a `revolute` joint and its `angle`")
                                 : fmt::format("it has {}", fmt::join(others, ", "))));
}

}  // namespace

int find_coordinate(const std::string& joint, std::optional<base::CoordinateChoice> asked,
                    base::CoordinateSort sort, MarkerFinder& find) {
  Model& model = find.model();
  const int index = find_joint(model, joint);
  if (index < 0) return -1;
  const Joint& owner = model.joints[static_cast<std::size_t>(index)];
  std::vector<base::CoordinateChoice> offered;
  for (const joints::NamedCoordinate& own : owner.coordinates) offered.push_back(own.which);
  const auto which = base::meant(offered, asked, sort);
  if (!which) refuse_in_plane(owner, asked.value_or(base::CoordinateChoice::angle));
  for (std::size_t k = 0; k < model.coordinates.size(); ++k) {
    const Coordinate& known = model.coordinates[k];
    if (known.joint == index && known.which == *which) return static_cast<int>(k);
  }
  const auto own = std::find(offered.begin(), offered.end(), *which) - offered.begin();
  model.coordinates.push_back({index, owner.first, owner.second,
                               owner.coordinates[static_cast<std::size_t>(own)].law, *which});
  return static_cast<int>(model.coordinates.size()) - 1;
}

bool is_joint_law(const loads::LoadSpec& spec) {
  return std::visit(
      []<class T>(const T&) {
        return requires { T::kTurns; };
      },
      spec.kind);
}

void add_lock(const joints::JointSpec& joint, MarkerFinder& find) {
  Model& model = find.model();
  const int owner = find_joint(model, joint.name);
  const std::size_t count =
      owner < 0 ? 0 : model.joints[static_cast<std::size_t>(owner)].coordinates.size();
  for (std::size_t k = 0; k < count; ++k) {
    const base::CoordinateChoice which =
        model.joints[static_cast<std::size_t>(owner)].coordinates[k].which;
    // A wheel's way is that of its angle: one row holds both.
    const joints::JointType type = model.joints[static_cast<std::size_t>(owner)].type;
    if (type == joints::JointType::rolling && which != base::CoordinateChoice::angle) continue;
    const int index = find_coordinate(joint.name, which, base::CoordinateSort::any, find);
    const Coordinate& coordinate = model.coordinates[static_cast<std::size_t>(index)];
    const bool is_known =
        std::any_of(model.loads.begin(), model.loads.end(), [&](const Load& load) {
          return load.coordinate == index && load.kind == loads::CoordinateLock::kKind;
        });
    if (is_known) continue;
    Load load;
    load.name = fmt::format("lock of {}", joint.name);
    load.kind = loads::CoordinateLock::kKind;
    load.first = coordinate.first;
    load.second = coordinate.second;
    load.coordinate = index;
    // Its first marker is the point of the beam where the slider is.
    if (model.joints[static_cast<std::size_t>(coordinate.joint)].track)
      load.joint = coordinate.joint;
    load.element = std::make_shared<loads::CoordinateLock>();
    model.loads.push_back(std::move(load));
  }
}

void add_joint_law(const loads::LoadSpec& spec, MarkerFinder& find, double length) {
  JointLawBuilder builder(spec, find, length);
  std::visit(
      [&]<class T>(const T& kind) {
        if constexpr (requires { T::kTurns; }) builder.add(kind);
      },
      spec.kind);
}

}  // namespace buckens::model
