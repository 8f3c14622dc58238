// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/shaft_watch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::analysis {

namespace {

// Cosine from which shafts count as across each other: of 89.99 degrees, where one of them turns
// up to 6000 times as fast as the other.
constexpr double kAcross = 1.7453e-4;
constexpr double kNearlyAcross = 0.08715574274765817;  // cosine of 85 degrees

[[noreturn]] void refuse(const model::ShaftPair& pair, double t, double cosine) {
  throw NumericalError(
      pair.cross->where,
      fmt::format("joint \"{}\" at t = {:.6g} s: the shafts that it connects, in joints \"{}\" and "
                  "\"{}\", have come to {:.4g} degrees to each other; a universal joint is "
                  "singular at 90 degrees and passes on no rotation there; let the bearings swing "
                  "less, stop the run before with an event, or use a `constant-velocity` joint",
                  pair.cross->name, t, pair.first.joint->name, pair.second.joint->name,
                  std::acos(std::abs(cosine)) * 180.0 / std::numbers::pi));
}

}  // namespace

ShaftWatch::ShaftWatch(const model::Model& model)
    : model_(model), pairs_(model::shaft_pairs(model)), motions_(model.bodies.size()) {}

void ShaftWatch::follow(int body, const model::State& state) {
  if (body == model::kGround) return;
  const auto b = static_cast<std::size_t>(body);
  dynamics::motion_of(model_.bodies[b], state.bodies[b], motions_[b]);
}

double ShaftWatch::cosine(const model::ShaftPair& pair, const model::State& state) {
  const auto axis = [&](const model::Bearing& bearing) -> Eigen::Vector3d {
    const model::Joint& joint = *bearing.joint;
    follow(joint.first.body, state);
    return dynamics::evaluate_marker(model_, joint.first, motions_).motion.R * joint.axis_F;
  };
  return axis(pair.first).dot(axis(pair.second));
}

void ShaftWatch::check(const model::State& before, const model::State& after) {
  for (const model::ShaftPair& pair : pairs_) {
    const double first = cosine(pair, before);
    const double last = cosine(pair, after);
    if (first * last > 0.0 && std::abs(last) > kAcross) continue;
    // Between the two along the chord, which is far below the step.
    const double share = first == last ? 1.0 : std::clamp(first / (first - last), 0.0, 1.0);
    const double t = first * last > 0.0 ? after.t : before.t + share * (after.t - before.t);
    refuse(pair, t, first * last > 0.0 ? last : 0.0);
  }
}

void ShaftWatch::check_failed(const model::State& before) {
  for (const model::ShaftPair& pair : pairs_) {
    const double now = cosine(pair, before);
    if (std::abs(now) < kNearlyAcross) refuse(pair, before.t, now);
  }
}

}  // namespace buckens::analysis
