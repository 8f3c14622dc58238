// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/forces.h"
#include "buckens/loads/turning_friction.h"

namespace buckens::stepping {

/// Balls and cross joints whose friction has turned round while a step is iterated: for one
/// iteration they are taken as sticking, as HeldLaws does with laws of joint coordinates.
class TurningBalls {
 public:
  /// @param model must outlive this object
  explicit TurningBalls(const model::Model& model);

  /// Keeps the directions of sliding that the tangents belong to.
  void note(const std::vector<dynamics::BodyMotion>& motions, double t,
            const dynamics::Circumstances& around);
  /// Whether any of them slides, and whether one of these has turned round since note().
  struct Sliding {
    bool any = false, has_reversed = false;
  };
  Sliding look(const std::vector<dynamics::BodyMotion>& motions, double t,
               const dynamics::Circumstances& around) const;
  /// Holds what has turned round since note(), gives it its tangents, and notes the rest.
  void hold_reversed(const std::vector<dynamics::BodyMotion>& motions, double t,
                     const dynamics::Circumstances& around, dynamics::SoftRows& tangents);
  void release() { held_.clear(); }
  bool any_held() const { return !held_.empty(); }
  bool holds(int soft) const;

  /// What bounds keep back of the torques of held rows at one instant: f(soft row, torque).
  template <class F>
  void for_excess(const std::vector<dynamics::BodyMotion>& motions, double t,
                  const dynamics::Circumstances& around, F&& f) const {
    for (const Held& row : held_) {
      f(balls_[row.ball].soft + row.row, rub(balls_[row.ball], motions, t, around).excess[row.row]);
    }
  }

 private:
  struct Ball {
    std::size_t load, regime;  // its places in Model::loads and Forces::regimes
    int soft;                  // the first of its soft rows
    const loads::TurningFriction* element;
    loads::TurningFriction::Rub noted;
  };
  struct Held {
    std::size_t ball;
    int row;  // among its own
  };
  loads::TurningFriction::Rub rub(const Ball& ball,
                                  const std::vector<dynamics::BodyMotion>& motions, double t,
                                  const dynamics::Circumstances& around) const;

  const model::Model& model_;
  std::vector<Ball> balls_;
  std::vector<Held> held_;
};

}  // namespace buckens::stepping
