// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/forces.h"
#include "buckens/loads/coordinate_law.h"
#include "buckens/stepping/turning_balls.h"

namespace buckens::stepping {

/// Laws of joint coordinates, balls and cross joints that are taken as sticking for one iteration.
///
/// The force of friction turns round within the tiny way of its elastic slip. Where it must stick,
/// a tangent of sliding goes past that way, and the next one, sliding backwards, past it again,
/// without end. A law that has gone from one end of its set to the other is therefore held: for one
/// iteration its set is the whole line, so that its spring is its tangent and its force. Afterwards
/// the set decides again.
class HeldLaws {
 public:
  /// @param model must outlive this object
  explicit HeldLaws(const model::Model& model);

  /// A step begins with tangents at these motions.
  void begin(const std::vector<dynamics::BodyMotion>& motions, double t,
             const dynamics::Circumstances& around) {
    release();
    balls_.note(motions, t, around);
  }
  /// Balls and cross joints, as against the tangents formed last.
  TurningBalls::Sliding look_at_balls(const std::vector<dynamics::BodyMotion>& motions, double t,
                                      const dynamics::Circumstances& around) const {
    return balls_.look(motions, t, around);
  }
  /// Holds the laws that have gone from one end to the other and gives them their tangents.
  /// @param before regimes of the tangents so far, @param tangents as the forces stand now
  void hold_reversed(const std::vector<int>& before,
                     const std::vector<dynamics::BodyMotion>& motions, double t,
                     const dynamics::Circumstances& around, dynamics::SoftRows& tangents);
  /// Lets all sets decide again.
  void release() {
    held_.clear();
    balls_.release();
  }
  bool any() const { return !held_.empty() || balls_.any_held(); }
  /// Whether a soft row is that of a held law.
  bool holds(int soft) const;

  /// What sets keep back from the forces of held laws at one instant: f(soft row, force).
  template <class F>
  void for_excess(const std::vector<dynamics::BodyMotion>& motions, double t,
                  const dynamics::Circumstances& around, F&& f) const {
    for (const Law& law : held_) f(law.soft, look(law, motions, t, around).excess);
    balls_.for_excess(motions, t, around, f);
  }

 private:
  struct Law {
    std::size_t load, regime;  // its places in Model::loads and Forces::regimes
    int soft;                  // its soft row
    const loads::CoordinateLaw* element;
  };
  loads::UnlimitedForce look(const Law& law, const std::vector<dynamics::BodyMotion>& motions,
                             double t, const dynamics::Circumstances& around) const;

  const model::Model& model_;
  std::vector<Law> laws_, held_;
  TurningBalls balls_;
};

}  // namespace buckens::stepping
