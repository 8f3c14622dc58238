// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/strand/sweep.h"

#include <array>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace buckens::stepping::strand {
namespace {

/// Blocks of bodies and joints that hold some of them, and what has been done with them.
class Blocks {
 public:
  Blocks(std::size_t bodies, const std::vector<std::vector<std::size_t>>& held) : held_(held) {
    for (std::size_t b = 0; b < bodies; ++b) {
      rows_.push_back(std::make_unique<std::array<double, 2 * kLanes>>());
      bodies_.emplace_back().rows = rows_.back()->data();
    }
    for (const auto& of_joint : held) {
      JointBlock& block = joints_.emplace_back();
      for (int end = 0; end < 2; ++end) {
        for (auto*& at : block.body[end]) at = ground_.data();
      }
      int lane = 0;
      for (const std::size_t b : of_joint) {
        block.body[lane % 2][lane / 2] = bodies_[b].rows + lane % kLanes;
        ++lane;
      }
    }
    turns_of_bodies_.assign(bodies, 0);
    turns_of_joints_.assign(held.size(), 0);
  }

  Sweep sweep() const { return Sweep(bodies_, joints_); }

  /// A turn of bodies that follows `joints` turns of joints.
  auto body_turn(int turn, int joints) {
    return [this, turn, joints, next = std::size_t{0}](std::size_t b) mutable {
      EXPECT_EQ(b, next++);
      EXPECT_EQ(turns_of_bodies_[b]++, turn);
      for (std::size_t j = 0; j < held_.size(); ++j) {
        if (holds(j, b)) EXPECT_GE(turns_of_joints_[j], joints) << "joint " << j << " body " << b;
      }
      order_.push_back(b);
    };
  }
  auto joint_turn(int turn, int bodies) {
    return [this, turn, bodies, next = std::size_t{0}](std::size_t j) mutable {
      EXPECT_EQ(j, next++);
      EXPECT_EQ(turns_of_joints_[j]++, turn);
      for (const std::size_t b : held_[j]) {
        EXPECT_GE(turns_of_bodies_[b], bodies) << "joint " << j << " body " << b;
      }
    };
  }
  void expect_turns(int of_bodies, int of_joints) const {
    for (const int turns : turns_of_bodies_) EXPECT_EQ(turns, of_bodies);
    for (const int turns : turns_of_joints_) EXPECT_EQ(turns, of_joints);
  }
  /// Bodies in the order of their turns.
  const std::vector<std::size_t>& order() const { return order_; }

 private:
  bool holds(std::size_t j, std::size_t b) const {
    for (const std::size_t one : held_[j]) {
      if (one == b) return true;
    }
    return false;
  }

  std::vector<std::vector<std::size_t>> held_;
  std::vector<std::unique_ptr<std::array<double, 2 * kLanes>>> rows_;
  std::array<double, 2 * kLanes> ground_{};
  std::vector<BodyBlock> bodies_;
  std::vector<JointBlock> joints_;
  std::vector<int> turns_of_bodies_, turns_of_joints_;
  std::vector<std::size_t> order_;
};

/// The first joint holds a body to the ground, the others two bodies.
std::vector<std::vector<std::size_t>> chain(std::size_t bodies) {
  std::vector<std::vector<std::size_t>> out = {{0}};
  for (std::size_t b = 0; b + 1 < bodies; ++b) out.push_back({b, b + 1});
  return out;
}

void expect_all_turns(Blocks blocks) {
  const Sweep sweep = blocks.sweep();
  sweep.joints_first(blocks.joint_turn(0, 0), blocks.body_turn(0, 1), blocks.joint_turn(1, 1),
                     blocks.body_turn(1, 2));
  blocks.expect_turns(2, 2);
  sweep.bodies_first(blocks.body_turn(2, 0), blocks.joint_turn(2, 3), blocks.body_turn(3, 3));
  blocks.expect_turns(4, 3);
}

TEST(Sweep, GivesEveryBlockItsTurnsInOrder) {
  expect_all_turns(Blocks(7, chain(7)));
  // A tree, joints that are not in the order of the bodies, a ring.
  expect_all_turns(Blocks(7, {{0}, {0, 1}, {0, 2}, {1, 3}, {1, 4}, {2, 5}, {2, 6}}));
  expect_all_turns(Blocks(4, {{3, 2}, {1, 2}, {0, 1}, {0}}));
  expect_all_turns(Blocks(4, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}));
  // Bodies without joints, first, between and last; joints to nothing but the ground.
  expect_all_turns(Blocks(5, {{1}, {1, 3}, {}}));
  expect_all_turns(Blocks(1, {{0}}));
}

TEST(Sweep, StaysNearAlongAChain) {
  constexpr std::size_t kBodies = 50;
  Blocks blocks(kBodies, chain(kBodies));
  blocks.sweep().joints_first(blocks.joint_turn(0, 0), blocks.body_turn(0, 1),
                              blocks.joint_turn(1, 1), blocks.body_turn(1, 2));
  // A body has its second turn when the first turn is no more than two bodies ahead.
  const std::vector<std::size_t>& order = blocks.order();
  ASSERT_EQ(order.size(), 2 * kBodies);
  std::size_t ahead = 0;
  for (const std::size_t b : order) {
    if (b == ahead) {
      ++ahead;
    } else {
      EXPECT_LE(ahead - b, 3U);
    }
  }
}

}  // namespace
}  // namespace buckens::stepping::strand
