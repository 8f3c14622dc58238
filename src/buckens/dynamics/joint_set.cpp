// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/joint_set.h"

#include "buckens/base/errors.h"
#include "buckens/dynamics/citing.h"
#include "buckens/dynamics/summed_coordinate.h"
#include "buckens/dynamics/travel.h"
#include "buckens/spatial/rotation.h"

namespace buckens::dynamics {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using spatial::Wrench;

namespace {

/// Rᵀ v, written out: there are many of these.
inline Vector3d against(const Matrix3d& R, const Vector3d& v) {
  return {R.col(0).dot(v), R.col(1).dot(v), R.col(2).dot(v)};
}

/// A row's value; what ends the motion there names the joint.
joints::RowValue value_of(const model::Joint& joint, const joints::ConstraintRow& row,
                          const spatial::MarkerMotion& F, const spatial::MarkerMotion& M, double t,
                          const double* states) {
  return citing(joint, t, [&] { return row.evaluate(F, M, t, states); });
}

/// Whether a joint holds nothing any more; its residuals are then zero.
bool has_let_go(const model::Model& model, std::size_t index, const model::RowMemory* memory,
                JointResiduals& out) {
  if (memory == nullptr || !memory->is_released(index)) return false;
  const model::Joint& joint = model.joints[index];
  for (linalg::Vector* values : {&out.g, &out.g_dot, &out.g_t}) {
    values->segment(joint.first_row, std::ssize(joint.rows)).setZero();
  }
  return true;
}

/// The interface values of a marker's translation or rotation.
inline Vector3d three(const Eigen::VectorXd& y, int row) { return y.segment<3>(row); }

}  // namespace

JointSet::JointSet(const model::Model& model)
    : model_(model), num_rows_(model.num_constraint_rows()) {
  const auto end_of = [&](const model::MarkerId& id) {
    End end;
    end.body = id.body;
    spatial::Pose place = id.X_WF;
    if (id.body != model::kGround) {
      const body::Marker& marker = model.bodies[static_cast<std::size_t>(id.body)]
                                       .markers[static_cast<std::size_t>(id.marker)];
      end.translation_row = marker.translation_row;
      end.rotation_row = marker.rotation_row;
      place = marker.X_BF;
    }
    end.z = place.p;
    end.R = place.R();
    end.is_turned = end.R != Matrix3d::Identity();
    return end;
  };
  joints_.reserve(model.joints.size());
  rows_.reserve(static_cast<std::size_t>(num_rows_));
  for (const model::Joint& joint : model.joints) {
    if (joint.rows.size() > kMostRows) {
      throw ModelError("joint \"" + joint.name + "\" has more than six equations");
    }
    const Joint& own = joints_.emplace_back(
        Joint{end_of(joint.first), end_of(joint.second), joint.first_row,
              static_cast<int>(joint.rows.size()), rows_.size(), coupled_.size(),
              joint.coupled.size(), 0, 0, joint.track ? &joint : nullptr});
    for (const model::CoupledCoordinate& coupled : joint.coupled) {
      const auto index = static_cast<std::size_t>(coupled.coordinate);
      const model::Joint& owner =
          model.joints[static_cast<std::size_t>(model.coordinates[index].joint)];
      coupled_.push_back({end_of(owner.first), end_of(owner.second), index, &coupled.term,
                          owner.track ? &coupled : nullptr});
    }
    int state = joint.first_state;
    for (const joints::ConstraintRow& row : joint.rows) {
      Kind kind = Kind::other;
      if (row.kind() == joints::ConstraintRow::Kind::point_world) kind = Kind::point;
      if (row.kind() == joints::ConstraintRow::Kind::direction && !row.depends_on_time()) {
        kind = Kind::direction;
      }
      const Vector3d b = kind == Kind::direction ? own.first.R * row.direction() : row.direction();
      rows_.push_back({kind, b, own.second.R * row.second_direction(), &row, state});
      state += row.num_states();
    }
  }
  take_laws();
}

JointSet::Motion JointSet::motion_of(const End& end, const std::vector<BodyMotion>& motions) {
  Motion out;
  if (end.body == model::kGround) {
    out.R_WB.setIdentity();
    out.axes.setIdentity();
    out.z.setZero();
    out.p = end.z;
    out.w.setZero();
    out.v.setZero();
    return out;
  }
  const BodyMotion& motion = motions[static_cast<std::size_t>(end.body)];
  const body::FrameMotion& frame = motion.frame;
  out.R_WB = frame.X_WB.R();
  out.axes = out.R_WB;
  out.z = end.z;
  Vector3d w = frame.w;
  Vector3d v = Vector3d::Zero();
  if (end.translation_row >= 0) {
    out.z += three(motion.y, end.translation_row);
    v = three(motion.y_dot, end.translation_row);
  }
  if (end.rotation_row >= 0) {
    const Vector3d theta = three(motion.y, end.rotation_row);
    out.rotation_map = spatial::left_jacobian(theta);
    w += out.rotation_map * three(motion.y_dot, end.rotation_row);
    out.axes = out.R_WB * spatial::exp_rotation(theta).toRotationMatrix();
  }
  v += frame.w.cross(out.z);
  out.p = frame.X_WB.p + out.R_WB * out.z;
  out.w = out.R_WB * w;
  out.v = frame.v + out.R_WB * v;
  return out;
}

void JointSet::add_wrench(const End& end, const Motion& motion, const Wrench& wrench, Forces& out) {
  if (end.body == model::kGround) return;
  const auto b = static_cast<std::size_t>(end.body);
  const Vector3d force = against(motion.R_WB, wrench.force);
  const Vector3d torque = against(motion.R_WB, wrench.torque);
  out.frame[b].head<3>() += torque + motion.z.cross(force);
  out.frame[b].tail<3>() += wrench.force;
  if (end.translation_row < 0) return;
  out.interface[b].segment<3>(end.translation_row) += force;
  if (end.rotation_row < 0) return;
  out.interface[b].segment<3>(end.rotation_row) += against(motion.rotation_map, torque);
}

void JointSet::derive(const End& end, const Motion& motion, const Wrench& wrench, BodyRow& out) {
  out.body = end.body;
  out.translation_row = end.translation_row;
  out.rotation_row = end.rotation_row;
  if (end.body == model::kGround) return;
  // A scalar with a derivative is the work of the wrench of that size on the marker.
  const Vector3d force = against(motion.R_WB, wrench.force);
  const Vector3d torque = against(motion.R_WB, wrench.torque);
  out.frame.head<3>() = (torque + motion.z.cross(force)).transpose();
  out.frame.tail<3>() = wrench.force.transpose();
  if (end.translation_row < 0) return;
  out.interface.head<3>() = force.transpose();
  out.interface.tail<3>().setZero();
  if (end.rotation_row < 0) return;
  out.interface.tail<3>() = against(motion.rotation_map, torque).transpose();
}

void JointSet::evaluate_coupler(const Joint& joint, const std::vector<BodyMotion>& motions,
                                double t, const model::RowMemory* memory, JointResiduals& out,
                                const linalg::Vector* lambda, Forces* forces) const {
  const double multiplier = lambda != nullptr ? (*lambda)[joint.first_row] : 0.0;
  joints::CouplerSum sum;
  double rate = 0.0;
  for (std::size_t k = 0; k < joint.num_coupled; ++k) {
    const Coupled& own = coupled_[joint.coupled + k];
    if (own.slider != nullptr) {
      const SummedCoordinate slider(model_, *own.slider, motions, t, memory);
      sum.add(*own.term, slider.value());
      rate += slider.rate();
      if (forces != nullptr) slider.add_forces(multiplier, *forces);
      continue;
    }
    const Motion F = motion_of(own.first, motions);
    const Motion M = motion_of(own.second, motions);
    const spatial::MarkerMotion first = F.marker(own.first);
    const spatial::MarkerMotion second = M.marker(own.second);
    const joints::CountedValue value =
        counted_coordinate(model_, own.coordinate, t, memory, first, second);
    sum.add(*own.term, value);
    const spatial::PairRow J =
        own.term->slope(value.value()) * model_.coordinates[own.coordinate].law.derivatives(
                                             first, second, before_of(memory, own.coordinate));
    rate += J.segment<3>(0).dot(F.w) + J.segment<3>(3).dot(F.v) + J.segment<3>(6).dot(M.w) +
            J.segment<3>(9).dot(M.v);
    if (forces == nullptr) continue;
    const spatial::PairRow f = multiplier * J;
    add_wrench(own.first, F, {f.segment<3>(0).transpose(), f.segment<3>(3).transpose()}, *forces);
    add_wrench(own.second, M, {f.segment<3>(6).transpose(), f.segment<3>(9).transpose()}, *forces);
  }
  const Row& drive = rows_[joint.rows];
  const double* const states =
      memory != nullptr && memory->rows.size() > 0 ? memory->rows.data() + drive.state : nullptr;
  const double ahead = drive.row->driven_rate(t, states);
  out.g[joint.first_row] = sum.value() - drive.row->driven_to(t, states);
  out.g_dot[joint.first_row] = rate - ahead;
  out.g_t[joint.first_row] = -ahead;
}

void JointSet::evaluate_slider(const model::Joint& joint, const std::vector<BodyMotion>& motions,
                               double t, const model::RowMemory* memory, JointResiduals& out,
                               const linalg::Vector* lambda, Forces* forces) const {
  const Travel travel(model_, joint, motions, memory);
  for (std::size_t k = 0; k < joint.rows.size(); ++k) {
    const Travel::Row value = travel.row(joint.rows[k], t);
    const int row = joint.first_row + static_cast<int>(k);
    out.g[row] = value.g;
    out.g_dot[row] = travel.rate_of(value);
    out.g_t[row] = value.g_t;
    if (forces == nullptr) continue;
    travel.add_force((*lambda)[row] * value.e, *forces);
  }
}

void JointSet::derive_coupler(const Joint& joint, const std::vector<BodyMotion>& motions, double t,
                              const model::RowMemory* memory, SystemRow& out) const {
  const auto index = static_cast<std::size_t>(&joint - joints_.data());
  size_coupler_row(model_, model_.joints[index], out);
  std::size_t part = 0;
  for (std::size_t k = 0; k < joint.num_coupled; ++k) {
    const Coupled& own = coupled_[joint.coupled + k];
    if (own.slider != nullptr) {
      SummedCoordinate(model_, *own.slider, motions, t, memory).derive(out, part);
      continue;
    }
    const Motion F = motion_of(own.first, motions);
    const Motion M = motion_of(own.second, motions);
    const spatial::MarkerMotion first = F.marker(own.first);
    const spatial::MarkerMotion second = M.marker(own.second);
    const double value =
        counted_coordinate(model_, own.coordinate, t, memory, first, second).value();
    const spatial::PairRow J =
        own.term->slope(value) * model_.coordinates[own.coordinate].law.derivatives(
                                     first, second, before_of(memory, own.coordinate));
    derive(own.first, F, {J.segment<3>(0).transpose(), J.segment<3>(3).transpose()},
           out.part(part++));
    derive(own.second, M, {J.segment<3>(6).transpose(), J.segment<3>(9).transpose()},
           out.part(part++));
  }
}

JointWrenches JointSet::evaluate_rows(std::size_t index, const Motion& F, const Motion& M, double t,
                                      const double* states, const linalg::Vector* lambda,
                                      JointResiduals& out, Wrench* units) const {
  const Joint& joint = joints_[index];
  const Vector3d r = M.p - F.p, r_dot = M.v - F.v, w = F.w - M.w;
  JointWrenches wrenches;
  Wrench& on_first = wrenches.on_first;
  Wrench& on_second = wrenches.on_second;
  for (int k = 0; k < joint.num_rows; ++k) {
    const Row& row = rows_[joint.rows + static_cast<std::size_t>(k)];
    const int at = joint.first_row + k;
    const double multiplier = lambda != nullptr ? (*lambda)[at] : 0.0;
    if (row.kind == Kind::point) {
      out.g[at] = row.b.dot(r);
      out.g_dot[at] = row.b.dot(r_dot);
      out.g_t[at] = 0.0;
      on_first.force -= multiplier * row.b;
      on_second.force += multiplier * row.b;
      if (units != nullptr) units[k] = {Vector3d::Zero(), row.b};
    } else if (row.kind == Kind::direction) {
      const Vector3d b = F.axes * row.b;
      const Vector3d c = M.axes * row.c;
      const Vector3d b_x_c = b.cross(c);
      out.g[at] = b.dot(c);
      out.g_dot[at] = b_x_c.dot(w);
      out.g_t[at] = 0.0;
      on_first.torque += multiplier * b_x_c;
      on_second.torque -= multiplier * b_x_c;
      if (units != nullptr) units[k] = {-b_x_c, Vector3d::Zero()};
    } else {
      const joints::RowValue value =
          value_of(model_.joints[index], *row.row, F.marker(joint.first), M.marker(joint.second), t,
                   states != nullptr ? states + row.state : nullptr);
      const auto& J = value.J;
      out.g[at] = value.g;
      out.g_t[at] = value.g_t;
      out.g_dot[at] = value.g_t + J.segment<3>(0).dot(F.w) + J.segment<3>(3).dot(F.v) +
                      J.segment<3>(6).dot(M.w) + J.segment<3>(9).dot(M.v);
      on_first +=
          {multiplier * J.segment<3>(0).transpose(), multiplier * J.segment<3>(3).transpose()};
      on_second +=
          {multiplier * J.segment<3>(6).transpose(), multiplier * J.segment<3>(9).transpose()};
      if (units != nullptr) units[k] = {J.segment<3>(6).transpose(), J.segment<3>(9).transpose()};
    }
  }
  return wrenches;
}

void JointSet::evaluate(const std::vector<BodyMotion>& motions, double t,
                        const model::RowMemory* memory, JointResiduals& out,
                        const linalg::Vector* lambda, Forces* forces, const Laws* with) const {
  const double* const states =
      memory != nullptr && memory->rows.size() > 0 ? memory->rows.data() : nullptr;
  for (linalg::Vector* values : {&out.g, &out.g_dot, &out.g_t}) values->resize(num_rows_);
  if (with != nullptr && with->slopes != nullptr) with->slopes->clear();
  if (with != nullptr && with->soft != nullptr) with->soft->resize(laws_.size());
  if (with != nullptr && with->ends != nullptr) with->ends->forget(model_);
  std::array<Wrench, kMostRows> units;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const Joint& joint = joints_[j];
    const bool has_laws = with != nullptr && joint.num_laws > 0;
    const bool is_released = has_let_go(model_, j, memory, out);
    if (is_released && !has_laws) continue;
    if (joint.num_coupled > 0) {
      evaluate_coupler(joint, motions, t, memory, out, lambda, forces);
      continue;
    }
    if (joint.slider != nullptr) {
      evaluate_slider(*joint.slider, motions, t, memory, out, lambda, forces);
      continue;
    }
    const Motion F = motion_of(joint.first, motions);
    const Motion M = motion_of(joint.second, motions);
    JointWrenches wrenches;
    Wrench* const filled = has_laws && with->slopes != nullptr ? units.data() : nullptr;
    if (!is_released) wrenches = evaluate_rows(j, F, M, t, states, lambda, out, filled);
    if (forces == nullptr) continue;
    if (has_laws) {
      const Look look{F, M, F.marker(joint.first), M.marker(joint.second)};
      act(joint, look, t, *with, is_released ? nullptr : filled, wrenches, *forces);
    }
    add_wrench(joint.first, F, wrenches.on_first, *forces);
    add_wrench(joint.second, M, wrenches.on_second, *forces);
  }
}

void JointSet::derivatives(std::size_t joint, const std::vector<BodyMotion>& motions, double t,
                           const model::RowMemory* memory,
                           std::array<SystemRow, kMostRows>& out) const {
  derive_held(joint, motions, t, memory, out);
  if (memory == nullptr || !memory->is_released(joint)) return;
  for (int k = 0; k < joints_[joint].num_rows; ++k) out[static_cast<std::size_t>(k)].clear();
}

void JointSet::derive_held(std::size_t joint, const std::vector<BodyMotion>& motions, double t,
                           const model::RowMemory* memory,
                           std::array<SystemRow, kMostRows>& out) const {
  const Joint& own = joints_[joint];
  if (own.num_coupled > 0) {
    return derive_coupler(own, motions, t, memory, out[0]);
  }
  if (own.slider != nullptr) {
    const Travel travel(model_, *own.slider, motions, memory);
    for (std::size_t k = 0; k < own.slider->rows.size(); ++k) {
      travel.derive(travel.row(own.slider->rows[k], t), own.first_row, out[k]);
    }
    return;
  }
  const double* const states =
      memory != nullptr && memory->rows.size() > 0 ? memory->rows.data() : nullptr;
  const Motion F = motion_of(own.first, motions);
  const Motion M = motion_of(own.second, motions);
  for (int k = 0; k < own.num_rows; ++k) {
    const Row& row = rows_[own.rows + static_cast<std::size_t>(k)];
    Wrench on_first, on_second;
    if (row.kind == Kind::point) {
      on_first.force = -row.b;
      on_second.force = row.b;
    } else if (row.kind == Kind::direction) {
      on_first.torque = (F.axes * row.b).cross(M.axes * row.c);
      on_second.torque = -on_first.torque;
    } else {
      const spatial::PairRow J =
          value_of(model_.joints[joint], *row.row, F.marker(own.first), M.marker(own.second), t,
                   states != nullptr ? states + row.state : nullptr)
              .J;
      on_first = {J.segment<3>(0).transpose(), J.segment<3>(3).transpose()};
      on_second = {J.segment<3>(6).transpose(), J.segment<3>(9).transpose()};
    }
    SystemRow& values = out[static_cast<std::size_t>(k)];
    values.more.clear();  // of a coupler before
    values.travelling = -1;
    derive(own.first, F, on_first, values.first);
    derive(own.second, M, on_second, values.second);
  }
}

}  // namespace buckens::dynamics
