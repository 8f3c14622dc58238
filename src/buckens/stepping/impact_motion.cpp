// SPDX-License-Identifier: Apache-2.0
// Effect of impulses on the bodies.
#include <algorithm>
#include <cmath>

#include "buckens/stepping/impacts.h"

namespace buckens::stepping {

using linalg::Vector;

namespace {
// A struck body leaves with at most twice the speed of what strikes it, and may be struck from two
// sides at different instants of a step: impacts move nothing further than this many times the
// distance that the fastest body travels in a step.
constexpr double kMostOfStep = 4.0;
}  // namespace

void Impacts::share_instants(const Vector& P) {
  const std::size_t count = model_.bodies.size();
  std::vector<Eigen::Vector3d> shifts(count, Eigen::Vector3d::Zero());
  std::vector<double> fastest(count, 0.0);  // of each island, by the body it is named by
  std::vector<char> is_apart(count, 0);
  for (std::size_t k = 0; k < num_pushes(); ++k) {
    const bool is_slip = k >= touches_.size();
    const Touch& touch = touches_[is_slip ? slips_[k - touches_.size()].touch : k];
    double& own = fastest[island_of(touch)];
    own = std::max(own, is_slip ? std::abs(slips_[k - touches_.size()].speed)
                                : std::max(touch.approach, std::abs(touch.target)));
    for (const PushedBody& moved : push(k).bodies) {
      shifts[moved.body] += (P[static_cast<Eigen::Index>(k)] * touch.rest) * moved.u.tail<3>();
    }
  }
  for (const Touch& touch : touches_) {
    const std::size_t island = island_of(touch);
    for (const PushedBody& moved : touch.bodies) {
      const double most = kMostOfStep * scheme_.h * fastest[island];
      if (shifts[moved.body].norm() > most) is_apart[island] = 1;
    }
  }
  for (const Touch& touch : touches_) {
    if (touch.is_of_step || moves_mesh(laws_[touch.law])) is_apart[island_of(touch)] = 0;
  }
  for (Touch& touch : touches_) {
    const std::size_t island = island_of(touch);
    touch.is_wedged = is_apart[island] != 0;
    if (touch.is_wedged) touch.rest = touches_[strongest_[island]].rest;
  }
}

void Impacts::move_bodies(const Vector& P) {
  for (std::size_t b = 0; b < jumps_.size(); ++b) {
    jumps_[b].velocity.setZero();
    jumps_[b].shift.setZero();
    jumps_[b].impulse.setZero(model_.bodies[b].num_interface_rows());
    jumps_[b].impulse_time.setZero(model_.bodies[b].num_interface_rows());
  }
  double strength = 0;
  rest_ = 0;
  for (std::size_t k = 0; k < num_pushes(); ++k) {
    const double p = P[static_cast<Eigen::Index>(k)];
    if (p == 0.0) continue;
    const bool is_slip = k >= touches_.size();
    const Touch& touch = touches_[is_slip ? slips_[k - touches_.size()].touch : k];
    if (!is_slip) {
      const double weight = p * std::abs(touch.target);
      strength += weight;
      // Friction impulses that hold to the end of the step already include its accelerations.
      const bool has_all = touch.stays && !laws_[touch.law].frictions.empty();
      if (!has_all) rest_ += weight * touch.rest;
    }
    const Push& own = push(k);
    for (const PushedBody& moved : own.bodies) {
      BodyJump& jump = jumps_[moved.body];
      jump.velocity += p * moved.u;
      // Bodies that no joint holds move on by themselves; for others, joints to meshes would open.
      const bool goes_by_itself = touch.is_of_step && is_free_[moved.body] != 0;
      jump.shift += (p * (goes_by_itself ? touch.since : touch.rest)) * moved.u;
      jump.impulse += p * moved.load;
      jump.impulse_time += (p * touch.rest) * moved.load;
    }
  }
  if (strength > 0.0) rest_ /= strength;
}

}  // namespace buckens::stepping
