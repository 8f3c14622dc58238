// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/turning_balls.h"

#include <algorithm>

#include "buckens/dynamics/travel.h"

namespace buckens::stepping {

namespace {

/// The rows of a ball that sticks do not act together.
void erase_mix(int first_row, dynamics::SoftRows& tangents) {
  const auto at = std::find(tangents.first_of_mix.begin(), tangents.first_of_mix.end(), first_row);
  if (at == tangents.first_of_mix.end()) return;
  tangents.mixes.erase(tangents.mixes.begin() + (at - tangents.first_of_mix.begin()));
  tangents.first_of_mix.erase(at);
}

}  // namespace

TurningBalls::TurningBalls(const model::Model& model) : model_(model) {
  std::size_t regime = 0;
  int soft = 0;
  for (std::size_t k = 0; k < model.loads.size(); ++k) {
    const model::Load& load = model.loads[k];
    const auto* ball = dynamic_cast<const loads::TurningFriction*>(load.element.get());
    if (ball != nullptr) balls_.push_back({k, regime, soft, ball, {}});
    if (dynamics::has_regimes(load)) ++regime;
    soft += load.element->num_soft_rows();
  }
  held_.reserve(3 * balls_.size());
}

loads::TurningFriction::Rub TurningBalls::rub(const Ball& ball,
                                              const std::vector<dynamics::BodyMotion>& motions,
                                              double t,
                                              const dynamics::Circumstances& around) const {
  if (around.memory != nullptr && around.memory->is_off(ball.load)) return {};
  const dynamics::LoadEnds ends =
      dynamics::ends_of(model_, model_.loads[ball.load], motions, around.memory);
  return ball.element->rub(dynamics::sight_of(model_, ball.load, t, around, ends));
}

void TurningBalls::note(const std::vector<dynamics::BodyMotion>& motions, double t,
                        const dynamics::Circumstances& around) {
  for (Ball& ball : balls_) ball.noted = rub(ball, motions, t, around);
}

TurningBalls::Sliding TurningBalls::look(const std::vector<dynamics::BodyMotion>& motions, double t,
                                         const dynamics::Circumstances& around) const {
  Sliding out;
  for (const Ball& ball : balls_) {
    const loads::TurningFriction::Rub now = rub(ball, motions, t, around);
    for (std::size_t k = 0; k < now.slides.size(); ++k) {
      out.any = out.any || now.slides[k];
      out.has_reversed = out.has_reversed || ball.element->reversed(ball.noted, now)[k];
    }
  }
  return out;
}

void TurningBalls::hold_reversed(const std::vector<dynamics::BodyMotion>& motions, double t,
                                 const dynamics::Circumstances& around,
                                 dynamics::SoftRows& tangents) {
  held_.clear();
  for (std::size_t b = 0; b < balls_.size(); ++b) {
    Ball& ball = balls_[b];
    loads::TurningFriction::Rub now = rub(ball, motions, t, around);
    const std::array<bool, 3> reversed = ball.element->reversed(ball.noted, now);
    for (std::size_t k = 0; k < reversed.size(); ++k) {
      if (!reversed[k] || !(now.stiffness > 0.0 || now.damping > 0.0)) continue;
      const auto row = static_cast<std::size_t>(ball.soft) + k;
      tangents.stiffness[row] = now.stiffness;
      tangents.damping[row] = now.damping;
      tangents.regimes[ball.regime] &= ~(1 << k);
      now.slides[k] = false;
      held_.push_back({b, static_cast<int>(k)});
      if (!ball.element->has_arms()) erase_mix(ball.soft, tangents);
    }
    ball.noted = now;
  }
}

bool TurningBalls::holds(int soft) const {
  return std::any_of(held_.begin(), held_.end(),
                     [&](const Held& row) { return balls_[row.ball].soft + row.row == soft; });
}

}  // namespace buckens::stepping
