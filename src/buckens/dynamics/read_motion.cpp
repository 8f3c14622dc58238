// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/read_motion.h"

#include "buckens/dynamics/travel.h"
#include "buckens/loads/contact.h"
#include "buckens/spatial/rotation.h"

namespace buckens::dynamics {

using Eigen::Vector3d;
using Quantity = model::MotionReading::Quantity;

namespace {

Vector3d relative(Quantity quantity, const spatial::MarkerMotion& F,
                  const spatial::MarkerMotion& M) {
  const Vector3d r = M.p - F.p;
  switch (quantity) {
    case Quantity::relative_position:
      return F.R.transpose() * r;
    case Quantity::relative_velocity:
      return F.R.transpose() * (M.v - F.v - F.w.cross(r));
    case Quantity::relative_rotation:
      return spatial::log_rotation(Eigen::Quaterniond(Eigen::Matrix3d(F.R.transpose() * M.R)));
    default:
      return F.R.transpose() * (M.w - F.w);
  }
}

double read_contact(const model::Model& model, const model::MotionReading& reading, double t,
                    const Circumstances& around, const LoadEnds& ends) {
  const auto index = static_cast<std::size_t>(reading.load);
  const auto& contact = static_cast<const loads::Contact&>(*model.loads[index].element);
  const loads::ContactReading all = contact.read(sight_of(model, index, t, around, ends));
  if (reading.quantity == Quantity::gap) return all.gap;
  if (around.memory != nullptr && around.memory->is_off(index)) return 0.0;
  return reading.quantity == Quantity::normal ? all.normal : all.friction;
}

/// Of a load, and the axes it is in.
Vector3d action(const model::Model& model, const model::MotionReading& reading, double t,
                const Circumstances& around, const LoadEnds& ends) {
  const loads::Action action =
      action_of(model, static_cast<std::size_t>(reading.load), t, around, ends);
  const Eigen::Matrix3d to_first = ends.first.motion.R.transpose();
  switch (reading.quantity) {
    case Quantity::force_on_second:
      return action.on_second.force;
    case Quantity::torque_on_second:
      return action.on_second.torque;
    case Quantity::torque_on_first:
      return -(to_first * action.on_second.torque);
    default:
      return to_first * action.on_first.force;
  }
}

double read_load(const model::Model& model, const model::MotionReading& reading,
                 const std::vector<BodyMotion>& motions, double t, const Circumstances& around) {
  const model::Load& load = model.loads[static_cast<std::size_t>(reading.load)];
  const LoadEnds ends = ends_of(model, load, motions, around.memory);
  if (reading.quantity >= Quantity::normal) return read_contact(model, reading, t, around, ends);
  Vector3d value = action(model, reading, t, around, ends);
  if (reading.quantity == Quantity::tension) {
    const spatial::MarkerMotion& F = ends.first.motion;
    const Vector3d line = F.R.transpose() * (ends.second.motion.p - F.p);
    return line.isZero(0.0) ? 0.0 : value.dot(line.normalized());
  }
  if (reading.axes) {
    value = evaluate_marker(model, *reading.axes, motions).motion.R.transpose() * value;
  }
  return reading.along.dot(value);
}

}  // namespace

double read_motion(const model::Model& model, const model::MotionReading& reading,
                   const std::vector<BodyMotion>& motions, double t, const Circumstances& around) {
  if (reading.load >= 0) return read_load(model, reading, motions, t, around);
  const spatial::MarkerMotion first = evaluate_marker(model, reading.first, motions).motion;
  Vector3d value;
  switch (reading.quantity) {
    case Quantity::position:
      value = model.origin + first.p;
      break;
    case Quantity::velocity:
      value = first.v;
      break;
    case Quantity::angular_velocity:
      value = first.w;
      break;
    case Quantity::distance:
      return (evaluate_marker(model, reading.second, motions).motion.p - first.p).norm();
    default:
      value =
          relative(reading.quantity, first, evaluate_marker(model, reading.second, motions).motion);
  }
  if (reading.axes) {
    value = evaluate_marker(model, *reading.axes, motions).motion.R.transpose() * value;
  }
  return reading.along.dot(value);
}

}  // namespace buckens::dynamics
