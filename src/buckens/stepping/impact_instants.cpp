// SPDX-License-Identifier: Apache-2.0
// Which impacts belong together, and the instant within the step at which each is.
#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "buckens/spatial/rotation.h"
#include "buckens/stepping/impacts.h"

namespace buckens::stepping {

namespace {

// What arrives with less than this fraction of the energy that it has at the end of the step does
// not strike: it is pressed there from the beginning.
constexpr double kPressed = 0.5;

/// Moves a motion back in time with its present velocities.
void go_back(double time, dynamics::BodyMotion& motion) {
  spatial::Pose& X = motion.frame.X_WB;
  X.p -= time * motion.frame.v;
  X.q = (X.q * spatial::exp_rotation(-time * motion.frame.w)).normalized();
  motion.y -= time * motion.y_dot;
}

}  // namespace

std::size_t Impacts::island_of(const Touch& touch) const {
  const model::Load& load = model_.loads[laws_[touch.law].load];
  return islands_.of(load.first.body, load.second.body);
}

void Impacts::find_islands() {
  islands_.start();
  for (const Touch& touch : touches_) {
    const model::Load& load = model_.loads[laws_[touch.law].load];
    islands_.unite(load.first.body, load.second.body);
  }
  std::vector<char> is_struck(jumps_.size(), 0);
  for (const Touch& touch : touches_) {
    if (touch.strikes) is_struck[island_of(touch)] = 1;
  }
  std::erase_if(touches_, [&](const Touch& touch) { return is_struck[island_of(touch)] == 0; });
  strongest_.assign(jumps_.size(), touches_.size());
  for (std::size_t k = 0; k < touches_.size(); ++k) {
    std::size_t& strongest = strongest_[island_of(touches_[k])];
    const bool is_first = strongest == touches_.size();
    if (is_first || touches_[k].approach > touches_[strongest].approach) strongest = k;
  }
}

double Impacts::since(const Touch& touch) {
  const bool is_pressed = touch.stays && touch.lost_share < kPressed;
  return is_pressed ? 0.0 : touch.is_of_step ? touch.since : touch.rest;
}

void Impacts::find_instants() {
  const auto is_free = [&](int body) {
    return body == model::kGround || is_free_[static_cast<std::size_t>(body)] != 0;
  };
  std::map<std::pair<int, int>, const Touch*> strongest;  // by the bodies
  for (const Touch& touch : touches_) {
    if (!touch.strikes) continue;
    const model::Load& load = model_.loads[laws_[touch.law].load];
    if (!is_free(load.first.body) || !is_free(load.second.body)) continue;
    const Touch*& known = strongest[std::minmax(load.first.body, load.second.body)];
    if (known == nullptr || touch.approach > known->approach) known = &touch;
  }
  for (Touch& touch : touches_) {
    const model::Load& load = model_.loads[laws_[touch.law].load];
    const auto own = strongest.find(std::minmax(load.first.body, load.second.body));
    touch.from = since(own == strongest.end() ? strongest_near(touch) : *own->second);
  }
}

std::size_t Impacts::find_moved(const Touch& touch, std::array<std::size_t, 2>& moved) const {
  const model::Load& load = model_.loads[laws_[touch.law].load];
  std::size_t count = 0;
  for (const int body : {load.first.body, load.second.body}) {
    if (body == model::kGround) continue;
    const auto b = static_cast<std::size_t>(body);
    if (jumps_[b].since != touch.from) moved[count++] = b;
  }
  return count;
}

void Impacts::go_to_instant(const Touch& touch, const std::vector<dynamics::BodyMotion>& motions,
                            std::vector<dynamics::BodyMotion>& then, MotionPair& kept) const {
  std::array<std::size_t, 2> moved{};
  const std::size_t count = find_moved(touch, moved);
  for (std::size_t k = 0; k < count; ++k) {
    dynamics::BodyMotion& motion = then[moved[k]];
    kept[k] = std::exchange(motion, motions[moved[k]]);
    go_back(touch.from, motion);
  }
}

void Impacts::leave_instant(const Touch& touch, std::vector<dynamics::BodyMotion>& then,
                            MotionPair& kept) const {
  std::array<std::size_t, 2> moved{};
  const std::size_t count = find_moved(touch, moved);
  for (std::size_t k = 0; k < count; ++k) then[moved[k]] = std::move(kept[k]);
}

std::vector<dynamics::BodyMotion> Impacts::at_impact(std::vector<dynamics::BodyMotion> motions) {
  for (std::size_t b = 0; b < motions.size(); ++b) {
    jumps_[b].since = 0.0;
    const std::size_t k = strongest_[islands_.of(b)];
    if (k == touches_.size()) continue;
    jumps_[b].since = since(touches_[k]);
    go_back(jumps_[b].since, motions[b]);
  }
  return motions;
}

}  // namespace buckens::stepping
