// SPDX-License-Identifier: Apache-2.0
#include "buckens/dynamics/travel.h"

#include <utility>

namespace buckens::dynamics {

using Eigen::Vector3d;

namespace {

/// A share without effect, on the rows of a marker.
BodyRow empty_share(const model::Model& model, const model::MarkerId& id) {
  const body::Marker& marker =
      model.bodies[static_cast<std::size_t>(id.body)].markers[static_cast<std::size_t>(id.marker)];
  BodyRow out;
  out.body = id.body;
  out.translation_row = marker.translation_row;
  out.rotation_row = marker.rotation_row;
  return out;
}

/// Room of LoadEnds that are no more.
struct Room {
  std::vector<body::MarkerKinematics> others;
  std::vector<spatial::MarkerMotion> motions;
};

std::vector<Room>& left_room() {
  thread_local std::vector<Room> room;
  return room;
}

}  // namespace

LoadEnds::~LoadEnds() {
  if (others.capacity() == 0) return;
  others.clear();
  other_motions.clear();
  left_room().push_back({std::move(others), std::move(other_motions)});
}

void LoadEnds::take_room() {
  if (left_room().empty()) return;
  others = std::move(left_room().back().others);
  other_motions = std::move(left_room().back().motions);
  left_room().pop_back();
}

Travel::Travel(const model::Model& model, const model::Joint& joint,
               const std::vector<BodyMotion>& motions, const double* states)
    : model_(model),
      joint_(joint),
      motions_(motions),
      states_(states),
      slider_(evaluate_marker(model, joint.second, motions)) {
  std::optional<double> guess;
  if (states != nullptr && states[0] > 0.0) guess = states[1];
  at_ = joint.track->shape.nearest(slider_.motion.p, guess, [this](std::size_t k) {
    return evaluate_marker(model_, node(k), motions_).motion;
  });
}

double Travel::rate() const { return along().dot(slider_.motion.v - at_.velocity()); }

spatial::MarkerMotion Travel::beam_motion() const {
  spatial::MarkerMotion out;
  out.p = at_.p;
  out.v = at_.velocity();
  out.R << at_.tangent.normalized(), at_.across(0), at_.across(1);
  const Vector3d t = out.R.col(0);
  out.w = t.cross(at_.tangent_rate()) / at_.tangent.norm();
  return out;
}

loads::CoordinateMotion Travel::coordinate(std::size_t coordinate,
                                           const model::RowMemory* memory) const {
  loads::CoordinateMotion out;
  out.value = displacement();
  out.rate = rate();
  out.J.segment<3>(3) = -along().transpose();
  out.J.segment<3>(9) = along().transpose();
  if (memory == nullptr || memory->coordinates.empty()) return out;
  out.change = out.value - memory->coordinates[coordinate].fraction;
  return out;
}

spatial::Wrench Travel::reaction(double t, const linalg::Vector& lambda) const {
  spatial::Wrench out;
  for (std::size_t k = 0; k < joint_.rows.size(); ++k) {
    out.force += lambda[joint_.first_row + static_cast<int>(k)] * row(joint_.rows[k], t).e;
  }
  return out;
}

Travel::Row Travel::row(const joints::ConstraintRow& row, double t) const {
  if (row.number() == 2) {
    return {displacement() - row.driven_to(t, drive()), -row.driven_rate(t, drive()), along()};
  }
  const Vector3d e = at_.across(row.number());
  return {e.dot(slider_.motion.p - at_.p), 0.0, e};
}

double Travel::rate_of(const Row& row) const {
  return row.e.dot(slider_.motion.v - at_.velocity()) + row.g_t;
}

void Travel::derive(const Row& row, int number, SystemRow& out) const {
  const std::vector<model::MarkerId>& bodies = joint_.track->bodies;
  const model::MarkerId& a = node(at_.element);
  const model::MarkerId& b = node(at_.element + 1);
  const SystemRow beam = system_row(model_, a, evaluate_marker(model_, a, motions_), b,
                                    evaluate_marker(model_, b, motions_), -at_.derivatives(row.e));
  spatial::PairRow on_slider = spatial::PairRow::Zero();
  on_slider.segment<3>(9) = row.e.transpose();
  const model::MarkerId nothing;
  out.second = system_row(model_, nothing, evaluate_marker(model_, nothing, motions_),
                          joint_.second, slider_, on_slider)
                   .second;
  // Two shares for every body: first, and all behind second.
  out.more.resize(num_parts(joint_) - 2);
  const auto share = [&out](std::size_t k) -> BodyRow& {
    return k == 0 ? out.first : out.more[k - 1];
  };
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const bool has_a = bodies[k].body == a.body;
    const bool has_b = bodies[k].body == b.body;
    share(2 * k) = has_a ? beam.first : empty_share(model_, bodies[k]);
    share(2 * k + 1) = has_b ? beam.second : empty_share(model_, bodies[k]);
  }
  out.travelling = number;
}

void Travel::add_force(const Vector3d& force, Forces& out) const {
  add_wrench(model_, joint_.second, slider_, {Vector3d::Zero(), force}, out);
  const spatial::PairRow on_beam = -at_.derivatives(force);
  const auto add = [&](const model::MarkerId& id, const Vector3d& torque, const Vector3d& push) {
    add_wrench(model_, id, evaluate_marker(model_, id, motions_), {torque, push}, out);
  };
  add(node(at_.element), on_beam.segment<3>(0).transpose(), on_beam.segment<3>(3).transpose());
  add(node(at_.element + 1), on_beam.segment<3>(6).transpose(), on_beam.segment<3>(9).transpose());
}

double Travel::bias(const joints::ConstraintRow& constraint, double t) const {
  const double out = bias_along(row(constraint, t).e);
  return constraint.number() == 2 ? out - constraint.driven_acceleration(t, drive()) : out;
}

double Travel::bias_along(const Vector3d& e) const {
  const double s_dot = rate();
  const Vector3d of_slider = evaluate_bias(model_, joint_.second, motions_).a;
  const Vector3d of_beam = at_.bias(evaluate_bias(model_, node(at_.element), motions_),
                                    evaluate_bias(model_, node(at_.element + 1), motions_));
  return e.dot(of_slider - of_beam - 2.0 * s_dot * at_.tangent_rate() -
               s_dot * s_dot * at_.curvature);
}

const model::Joint* slider_of(const model::Model& model, const model::Coordinate& coordinate) {
  if (coordinate.joint < 0) return nullptr;
  const model::Joint& joint = model.joints[static_cast<std::size_t>(coordinate.joint)];
  return joint.track ? &joint : nullptr;
}

LoadEnds ends_of(const model::Model& model, const model::Load& load,
                 const std::vector<BodyMotion>& motions, const model::RowMemory* memory) {
  LoadEnds out;
  const model::Joint* const joint =
      load.joint >= 0 ? &model.joints[static_cast<std::size_t>(load.joint)] : nullptr;
  if (joint != nullptr && joint->track) {
    out.travel.emplace(model, *joint, motions, memory);
    out.first.motion = out.travel->beam_motion();
    out.second = out.travel->slider();
    return out;
  }
  out.first = evaluate_marker(model, load.first, motions);
  out.second = evaluate_marker(model, load.second, motions);
  if (!load.others.empty()) out.take_room();
  for (const model::MarkerId& id : load.others) {
    out.others.push_back(evaluate_marker(model, id, motions));
    out.other_motions.push_back(out.others.back().motion);
  }
  return out;
}

void row_of(const model::Model& model, const model::Load& load, const LoadEnds& ends,
            const spatial::PairRow& J, SystemRow& out) {
  if (!ends.travel) {
    out = system_row(model, load.first, ends.first, load.second, ends.second, J);
    return;
  }
  // Numbers behind those of joints: it is where the forces are, its joint where the step ends.
  const int number = model.num_constraint_rows() + load.coordinate;
  ends.travel->derive({0.0, 0.0, J.segment<3>(9).transpose()}, number, out);
}

bool EndsInTurn::are_of(const model::Load& load) const {
  // Points of the ground differ by where they are.
  const auto is_same = [](const model::MarkerId& a, const model::MarkerId& b) {
    if (a.body != b.body || a.marker != b.marker) return false;
    return a.body != model::kGround ||
           (a.X_WF.p == b.X_WF.p && a.X_WF.q.coeffs() == b.X_WF.q.coeffs());
  };
  return last_ != nullptr && load.joint < 0 && last_->joint < 0 && load.others.empty() &&
         last_->others.empty() && is_same(load.first, last_->first) &&
         is_same(load.second, last_->second);
}

const LoadEnds& EndsInTurn::of(const model::Load& load) {
  if (!are_of(load)) ends_.emplace(ends_of(model_, load, motions_, memory_));
  last_ = &load;
  return *ends_;
}

loads::Sight sight_of(const model::Model& model, std::size_t load, double t,
                      const Circumstances& around, const LoadEnds& ends) {
  loads::Sight out =
      sight_of(model, load, t, around, ends.first.motion, ends.second.motion, ends.travels());
  out.others = ends.other_motions;
  return out;
}

loads::Action action_of(const model::Model& model, std::size_t load, double t,
                        const Circumstances& around, const LoadEnds& ends) {
  if (ends.others.empty()) {
    return action_of(model, load, t, around, ends.first.motion, ends.second.motion, ends.travels());
  }
  if (around.memory != nullptr && around.memory->is_off(load)) return {};
  return model.loads[load].element->respond(sight_of(model, load, t, around, ends));
}

void add_to_others(const model::Model& model, std::size_t load, double t,
                   const Circumstances& around, const LoadEnds& ends,
                   std::span<spatial::Wrench> wrenches) {
  if (around.memory != nullptr && around.memory->is_off(load)) return;
  model.loads[load].element->add_to_others(sight_of(model, load, t, around, ends), wrenches);
}

loads::CoordinateMotion coordinate_motion(const model::Model& model, std::size_t coordinate,
                                          double t, const model::RowMemory* memory,
                                          const std::vector<BodyMotion>& motions) {
  const model::Coordinate& own = model.coordinates[coordinate];
  if (const model::Joint* slider = slider_of(model, own)) {
    return Travel(model, *slider, motions, memory).coordinate(coordinate, memory);
  }
  return coordinate_motion(model, coordinate, t, memory,
                           evaluate_marker(model, own.first, motions).motion,
                           evaluate_marker(model, own.second, motions).motion);
}

}  // namespace buckens::dynamics
