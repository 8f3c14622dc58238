// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/add_ball_friction.h"

#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "buckens/joints/turning_rate.h"
#include "buckens/loads/ball_bristles.h"
#include "buckens/loads/ball_friction.h"
#include "buckens/loads/bristle_friction.h"
#include "buckens/loads/rigid_ball_friction.h"
#include "buckens/model/build/add_joint_law.h"
#include "buckens/model/build/friction_laws.h"
#include "buckens/spatial/plane.h"

namespace buckens::model {

using Eigen::Vector3d;

namespace {

// Elastic turn before friction breaks away, as of hinges [rad].
constexpr double kSlipAngle = 1e-5;

/// Half the harmonic mean of both rotary inertias moves, as of two free bodies.
double moved_rotary_inertia(const Model& model, const Joint& joint) {
  double inverse = 0.0;
  for (const MarkerId* id : {&joint.first, &joint.second}) {
    if (id->body == kGround) continue;
    const double own = model.bodies[static_cast<std::size_t>(id->body)].J0.trace() / 3.0;
    if (own > 0.0) inverse += 1.0 / own;
  }
  return inverse > 0.0 ? 1.0 / inverse : 0.0;
}

/// Lets a load act on the rate of turning about an axis of its first marker.
void set_turning_rate(const Vector3d& axis_F, Model& model, Load& load) {
  load.coordinate = static_cast<int>(model.coordinates.size());
  model.coordinates.push_back(
      {-1, load.first, load.second,
       joints::JointCoordinate::measured(std::make_shared<joints::TurningRate>(axis_F))});
}

/// Takes the first of several loads, of one in the model file. @return those behind it
std::vector<Load> take_first(std::vector<Load> rows, Load& load) {
  load = std::move(rows.front());
  rows.erase(rows.begin());
  return rows;
}

loads::BristleData bristles_of(const loads::BallFrictionSpec& spec) {
  return {*spec.bristle_stiffness, spec.bristle_damping.value_or(0.0), spec.elastic_share};
}

/// A law of the angle of each arm, whose bearing sees all of the force. @return the other one
std::vector<Load> set_arms(const loads::BallFrictionSpec& spec, loads::FrictionData data,
                           MarkerFinder& find, Load& load) {
  data.pins_radius = std::exchange(data.radius, 0.0);
  std::vector<Load> rows(2, load);
  const auto set = [&](base::CoordinateChoice arm, Load& row) {
    row.coordinate = find_coordinate(spec.joint, arm, base::CoordinateSort::angles, find);
    const auto index = static_cast<std::size_t>(row.coordinate);
    const Vector3d axis = find.model().coordinates[index].law.axis();
    if (spec.stick == loads::FrictionStick::rigid) {
      row.element = std::make_shared<loads::RigidFriction>(data, axis, friction_laws(spec));
    } else {
      row.element = std::make_shared<loads::BristleFriction>(data, bristles_of(spec), axis,
                                                             friction_laws(spec));
    }
  };
  set(base::CoordinateChoice::angle, rows.front());
  set(base::CoordinateChoice::second_angle, rows.back());
  return take_first(std::move(rows), load);
}

/// One row for each axis that is free. @return the loads behind the first
std::vector<Load> set_rigid_ball(const loads::FrictionData& data, loads::FrictionLaws laws,
                                 MarkerFinder& find, Load& load) {
  Model& model = find.model();
  if (model.planar) {
    // A hinge about the normal: all of its force is across that.
    const Vector3d axis = find.placed(load.first).R().transpose() * spatial::normal(*model.planar);
    load.element = std::make_shared<loads::RigidFriction>(data, axis, std::move(laws));
    set_turning_rate(axis, model, load);
    return {};
  }
  std::vector<Load> rows(loads::RigidBallFriction::kRows, load);
  for (int k = 0; k < loads::RigidBallFriction::kRows; ++k) {
    Load& row = rows[static_cast<std::size_t>(k)];
    row.element = std::make_shared<loads::RigidBallFriction>(data, k, laws);
    set_turning_rate(Vector3d::Unit(k), model, row);
  }
  return take_first(std::move(rows), load);
}

}  // namespace

std::vector<Load> set_ball_friction(const loads::BallFrictionSpec& spec, MarkerFinder& find,
                                    Load& load, const SourceLocation& where) {
  const Model& model = find.model();
  std::size_t j = 0;
  while (model.joints[j].name != spec.joint || model.joints[j].is_tie) ++j;
  const Joint& joint = model.joints[j];
  load.joint = static_cast<int>(j);
  load.first = joint.first;
  load.second = joint.second;
  const std::string what = fmt::format("load \"{}\"", load.name);
  find.require_moment(load.first, what, where);
  find.require_moment(load.second, what, where);
  loads::FrictionData data;
  data.stribeck_rate = spec.stribeck.value_or(0.0);
  data.slip = spec.slip.value_or(kSlipAngle);
  data.radius = spec.radius;
  const bool is_cross = joint.type == joints::JointType::universal;
  if (is_cross && spec.stick != loads::FrictionStick::elastic) {
    return set_arms(spec, data, find, load);
  }
  if (spec.stick == loads::FrictionStick::rigid) {
    return set_rigid_ball(data, friction_laws(spec), find, load);
  }
  data.inertia = moved_rotary_inertia(model, joint);
  if (spec.stick == loads::FrictionStick::bristles) {
    load.element =
        std::make_unique<loads::BallBristles>(data, bristles_of(spec), friction_laws(spec));
    return {};
  }
  std::optional<loads::BallFriction::Arms> arms;
  if (is_cross) {
    const joints::ConstraintRow& cross = joint.rows.back();
    arms = {cross.direction(), cross.second_direction()};
  }
  load.element = std::make_unique<loads::BallFriction>(data, arms, friction_laws(spec));
  return {};
}

}  // namespace buckens::model
