// SPDX-License-Identifier: Apache-2.0
// Joints of a StrandMechanism, and the pairs of them that meet on a body.
#include <algorithm>
#include <utility>

#include "buckens/stepping/strand/mechanism.h"

namespace buckens::stepping {

using strand::BodyRows;
using strand::entry;
using strand::JointRows;
using strand::kLanes;
using strand::MeshRows;
using strand::Plane;
using strand::SlotRows;
using strand::Space;

namespace {

void fill_ground(double* at, bool is_planar) {
  const auto fill = [&]<class S>(S) {
    using Row = BodyRows<S>;
    for (int lane = 0; lane < kLanes; ++lane) {
      double* const t = at + lane;
      entry(t, Row::q) = 1.0;
      for (int k = 0; k < S::T; ++k) {
        const int diagonal = S::T == 2 ? 0 : 4 * k;
        entry(t, Row::turn + diagonal) = entry(t, Row::turn0 + diagonal) = 1.0;
      }
    }
  };
  is_planar ? fill(Plane{}) : fill(Space{});
}

}  // namespace

template <class S>
Eigen::Matrix3d StrandMechanism::place_end(const model::MarkerId& id, int end, int lane,
                                           strand::JointBlock& block) {
  using Row = BodyRows<S>;
  if (id.body == model::kGround) {
    // One of its own: forces on it are not looked at.
    double* const own = rows(Row::count);
    fill_ground(own, S::T == 2);
    double* const slot = own + kLanes * Row::slots;
    for (int k = 0; k < S::T; ++k) {
      entry(slot, SlotRows<S>::p + k) = id.X_WF.p[k];
      entry(slot, SlotRows<S>::axes + (S::T == 2 ? 0 : 4 * k)) = 1.0;
    }
    block.body[end][lane] = own;
    block.slot[end][lane] = slot;
    return id.X_WF.R();
  }
  const auto b = static_cast<std::size_t>(id.body);
  const int which = slot_of(id);
  block.body[end][lane] = bodies_[b].at;
  block.which[end][lane] = which;
  block.slot[end][lane] = bodies_[b].at + kLanes * (Row::slots + which * SlotRows<S>::count);
  if (bodies_[b].has_mesh) watch_node(b, which);
  return model_.bodies[b].markers[static_cast<std::size_t>(id.marker)].X_BF.R();
}

void StrandMechanism::watch_node(std::size_t b, int node) {
  const int seen = is_planar_ ? MeshRows<Plane>::seen : MeshRows<Space>::seen;
  entry(bodies_[b].at, seen + node) = 1.0;
}

int StrandMechanism::slot_of(const model::MarkerId& id) const {
  const auto b = static_cast<std::size_t>(id.body);
  if (!bodies_[b].has_mesh) return slots_[b][0] == id.marker ? 0 : 1;
  const body::Body& body = model_.bodies[b];
  return node_of(body, body.markers[static_cast<std::size_t>(id.marker)]);
}

template <class S>
void StrandMechanism::place_joint(std::size_t j, int lane, strand::JointBlock& block) {
  using Row = JointRows<S>;
  const model::Joint& joint = model_.joints[j];
  double* const t = block.rows + lane;
  block.first_row[lane] = joint.first_row;
  const Eigen::Matrix3d first = place_end<S>(joint.first, 0, lane, block);
  const Eigen::Matrix3d second = place_end<S>(joint.second, 1, lane, block);
  for (int k = 0; k < block.num_directions; ++k) {
    const joints::ConstraintRow& row = joint.rows[static_cast<std::size_t>(S::T + k)];
    const Eigen::Vector3d b = first * row.direction();
    const Eigen::Vector3d c = second * row.second_direction();
    for (int i = 0; i < S::T; ++i) {
      entry(t, Row::b + k * S::T + i) = b[i];
      entry(t, Row::c + k * S::T + i) = c[i];
    }
  }
  multipliers_[j] = t + kLanes * Row::lambda;
  sides_[j] = {t + kLanes * Row::side, t + kLanes * (Row::side + Row::side_count)};
}

template <class S>
void StrandMechanism::lay_out_joints() {
  ground_ = rows(BodyRows<S>::count);
  fill_ground(ground_, S::T == 2);
  const std::size_t count = model_.joints.size();
  multipliers_.resize(count);
  sides_.resize(count);
  for (int directions = 0; directions <= S::R; ++directions) {
    int lane = kLanes;
    for (std::size_t j = 0; j < count; ++j) {
      if (std::ssize(model_.joints[j].rows) != S::T + directions) continue;
      if (lane == kLanes) {
        lane = 0;
        strand::JointBlock& fresh = joint_blocks_.emplace_back();
        fresh.rows = rows(JointRows<S>::count);
        fresh.num_directions = directions;
        for (int end = 0; end < 2; ++end) {
          std::fill_n(fresh.body[end], kLanes, ground_);
          std::fill_n(fresh.slot[end], kLanes, ground_ + kLanes * BodyRows<S>::slots);
        }
      }
      place_joint<S>(j, lane, joint_blocks_.back());
      joint_blocks_.back().num_lanes = ++lane;
    }
  }
}

template <class S>
void StrandMechanism::lay_out_pairs() {
  struct End {
    int joint, side, which;
  };
  std::vector<std::vector<End>> on_body(model_.bodies.size());
  std::vector<int> sizes;
  std::vector<std::pair<int, int>> couples;
  for (std::size_t j = 0; j < model_.joints.size(); ++j) {
    const model::Joint& joint = model_.joints[j];
    sizes.push_back(static_cast<int>(joint.rows.size()));
    for (int side = 0; side < 2; ++side) {
      const model::MarkerId& id = side == 0 ? joint.first : joint.second;
      if (id.body == model::kGround) continue;
      on_body[static_cast<std::size_t>(id.body)].push_back(
          {static_cast<int>(j), side, slot_of(id)});
    }
  }
  for (const auto& ends : on_body) {
    for (const End& i : ends) {
      for (const End& j : ends) couples.emplace_back(i.joint, j.joint);
    }
  }
  matrix_ = std::make_unique<linalg::BlockLu>(sizes, couples);
  for (const bool has_mesh : {false, true}) {
    int lane = kLanes;
    for (std::size_t b = 0; b < on_body.size(); ++b) {
      if (bodies_[b].has_mesh != has_mesh) continue;
      for (const End& i : on_body[b]) {
        for (const End& j : on_body[b]) {
          if (lane == kLanes) {
            lane = 0;
            pair_blocks_.emplace_back().has_mesh = has_mesh;
          }
          strand::PairBlock& block = pair_blocks_.back();
          const int place = matrix_->place(i.joint, j.joint);
          // Lanes behind stay where this one is until they are needed.
          for (int k = lane; k < kLanes; ++k) {
            const auto set = [&](int side, const End& end) {
              block.side[side][k] =
                  sides_[static_cast<std::size_t>(end.joint)][static_cast<std::size_t>(end.side)];
              block.which[side][k] = end.which;
              block.sign[side][k] = end.side == 0 ? -1.0 : 1.0;
              block.directions[side][k] = sizes[static_cast<std::size_t>(end.joint)] - S::T;
            };
            set(0, i);
            set(1, j);
            block.body[k] = bodies_[b].at;
            block.fixed[k] = bodies_[b].fixed;
            block.out[k] = matrix_->block(place);
            block.stride[k] = matrix_->stride(place);
          }
          block.num_lanes = ++lane;
        }
      }
    }
  }
}

template void StrandMechanism::lay_out_joints<Plane>();
template void StrandMechanism::lay_out_joints<Space>();
template void StrandMechanism::lay_out_pairs<Plane>();
template void StrandMechanism::lay_out_pairs<Space>();

}  // namespace buckens::stepping
