// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/statics/linearised_loads.h"

#include <algorithm>
#include <utility>

#include "buckens/analysis/statics/tolerances.h"
#include "buckens/body/body_lengths.h"
#include "buckens/dynamics/contact_groups.h"
#include "buckens/dynamics/forces.h"
#include "buckens/dynamics/row_memory.h"
#include "buckens/model/contact_group.h"
#include "buckens/spatial/rotation.h"

namespace buckens::analysis {

using dynamics::BodyMotion;
using dynamics::BodyRow;
using linalg::Vector;

namespace {

constexpr double kAhead = 1.0;  // [s]; bodies at rest go nowhere in it

using BodyLists = std::vector<std::vector<std::size_t>>;

void connect(const model::MarkerId& first, const model::MarkerId& second, BodyLists& out) {
  if (first.body == model::kGround || second.body == model::kGround) return;
  out[static_cast<std::size_t>(first.body)].push_back(static_cast<std::size_t>(second.body));
  out[static_cast<std::size_t>(second.body)].push_back(static_cast<std::size_t>(first.body));
}

void sort_lists(BodyLists& lists) {
  for (auto& list : lists) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
}

/// Bodies affected by a body's motion, including itself.
BodyLists neighbours_of(const model::Model& model) {
  BodyLists out(model.bodies.size());
  for (std::size_t b = 0; b < out.size(); ++b) out[b].push_back(b);
  for (const model::Joint& joint : model.joints) connect(joint.first, joint.second, out);
  for (const model::Load& load : model.loads) {
    std::vector<model::MarkerId> all = load.others;
    all.insert(all.end(), {load.first, load.second});
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) connect(all[i], all[j], out);
    }
  }
  sort_lists(out);
  return out;
}

/// Greedy distance-two colouring: no body is affected by two bodies of one colour.
BodyLists colors_of(const BodyLists& neighbours) {
  BodyLists colors;
  std::vector<std::size_t> color(neighbours.size(), neighbours.size());
  for (std::size_t b = 0; b < neighbours.size(); ++b) {
    std::vector<bool> taken(colors.size() + 1, false);
    for (const std::size_t near : neighbours[b]) {
      for (const std::size_t far : neighbours[near]) {
        if (color[far] < taken.size()) taken[color[far]] = true;
      }
    }
    color[b] =
        static_cast<std::size_t>(std::find(taken.begin(), taken.end(), false) - taken.begin());
    if (color[b] == colors.size()) colors.emplace_back();
    colors[color[b]].push_back(b);
  }
  return colors;
}

}  // namespace

LinearisedLoads::LinearisedLoads(const model::Model& model, const RestRows* rest)
    : model_(model), rest_(rest) {
  neighbours_.of = neighbours_of(model);
  neighbours_.colors = colors_of(neighbours_.of);
  for (const body::Body& body : model.bodies) {
    BodyCoordinates place;
    place.first = size_;
    place.rotations = static_cast<int>(body.rotation_basis.cols());
    place.translations = static_cast<int>(body.translation_basis.cols());
    place.rows = body.num_interface_rows();
    size_ += place.size();
    bodies_.push_back(place);
    lengths_.push_back(body::interface_lengths(body, model.length));
  }
}

LinearisedLoads::Neighbours LinearisedLoads::neighbours_at(
    const std::vector<BodyMotion>& motions) const {
  Neighbours out = neighbours_;
  if (model_.contact_groups.empty()) return out;
  // With what differences may bring into touch: found a share of the bodies' sizes ahead.
  for (const model::NearPair& pair : dynamics::find_near(model_, motions, kAhead)) {
    const model::ContactGroup& group = *model_.contact_groups[static_cast<std::size_t>(pair.group)];
    connect(group.members[static_cast<std::size_t>(pair.first)].marker,
            group.members[static_cast<std::size_t>(pair.second)].marker, out.of);
  }
  sort_lists(out.of);
  out.colors = colors_of(out.of);
  return out;
}

double LinearisedLoads::step(std::size_t body, int k) const {
  const BodyCoordinates& place = bodies_[body];
  if (k < place.rotations) return kDifference;
  if (k < place.num_frame()) return kDifference * model_.length;
  return kDifference * model_.length / lengths_[body][k - place.num_frame()];
}

Vector LinearisedLoads::gradient(const BodyRow& part) const {
  const auto b = static_cast<std::size_t>(part.body);
  const BodyCoordinates& place = bodies_[b];
  Vector out = Vector::Zero(place.size());
  out.head(place.rotations) =
      model_.bodies[b].rotation_basis.transpose() * part.frame.head<3>().transpose();
  out.segment(place.rotations, place.translations) =
      model_.bodies[b].translation_basis.transpose() * part.frame.tail<3>().transpose();
  auto y = out.tail(place.rows);
  if (part.translation_row >= 0) {
    y.segment<3>(part.translation_row) += part.interface.head<3>().transpose();
  }
  if (part.rotation_row >= 0) {
    y.segment<3>(part.rotation_row) += part.interface.tail<3>().transpose();
  }
  return out;
}

Vector LinearisedLoads::loads_after(const std::vector<BodyMotion>& motions, const Acting& acting,
                                    const Vector& step) const {
  std::vector<BodyMotion> moved = motions;
  for (std::size_t b = 0; b < moved.size(); ++b) {
    const BodyCoordinates& place = bodies_[b];
    const body::Body& body = model_.bodies[b];
    const auto own = step.segment(place.first, place.size());
    spatial::Pose& pose = moved[b].frame.X_WB;
    pose.p += body.translation_basis * own.segment(place.rotations, place.translations);
    const Eigen::Vector3d psi = body.rotation_basis * own.head(place.rotations);
    pose.q = (pose.q * spatial::exp_rotation(psi)).normalized();
    moved[b].y.head(place.rows) += own.tail(place.rows);
  }
  dynamics::Forces forces;
  dynamics::Constraints constraints;
  const model::RowMemory memory = dynamics::memory_at_rest(model_, moved, acting.t, acting.lambda);
  dynamics::evaluate_constraints(model_, moved, acting.t, &memory, constraints);
  dynamics::evaluate_forces(model_, moved, acting.t, forces, acting.load_factor);
  dynamics::add_joint_forces(constraints, acting.lambda, forces);
  if (rest_ != nullptr && !acting.stands.empty()) {
    RestValues values;
    rest_->evaluate(moved, acting.t, values);
    rest_->add_forces(values, acting.stands, forces);
  }
  Vector out(size_);
  for (std::size_t b = 0; b < moved.size(); ++b) {
    const BodyCoordinates& place = bodies_[b];
    const body::Body& body = model_.bodies[b];
    out.segment(place.first, place.size())
        << body.rotation_basis.transpose() * forces.frame[b].head<3>(),
        body.translation_basis.transpose() * forces.frame[b].tail<3>(),
        forces.interface[b].head(place.rows);
  }
  return out;
}

std::vector<LinearisedLoads::Block> LinearisedLoads::stiffness(
    const std::vector<BodyMotion>& motions, double t, const Vector& lambda, double load_factor,
    const RestStands& stands) const {
  const Acting acting{t, lambda, load_factor, stands};
  const Neighbours neighbours = neighbours_at(motions);
  std::vector<Block> out;
  for (const std::vector<std::size_t>& color : neighbours.colors) {
    const std::size_t first_block = out.size();
    int most = 0;
    for (const std::size_t b : color) {
      most = std::max(most, bodies_[b].size());
      for (const std::size_t near : neighbours.of[b]) {
        out.push_back({near, b, Eigen::MatrixXd(bodies_[near].size(), bodies_[b].size())});
      }
    }
    for (int k = 0; k < most; ++k) {
      Vector moved = Vector::Zero(size_);
      for (const std::size_t b : color) {
        if (k < bodies_[b].size()) moved[bodies_[b].first + k] = step(b, k);
      }
      const Vector change =
          loads_after(motions, acting, moved) - loads_after(motions, acting, -moved);
      for (std::size_t i = first_block; i < out.size(); ++i) {
        Block& block = out[i];
        if (k >= bodies_[block.by].size()) continue;
        const BodyCoordinates& on = bodies_[block.on];
        block.stiffness.col(k) = -change.segment(on.first, on.size()) / (2.0 * step(block.by, k));
      }
    }
  }
  return out;
}

}  // namespace buckens::analysis
