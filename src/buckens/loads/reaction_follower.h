// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/loads/force_element.h"

namespace buckens::loads {

/// A force law whose force grows with the reaction of its joint: friction.
class ReactionFollower {
 public:
  virtual ~ReactionFollower() = default;

  /// Appends, for each soft row of the law, the derivatives of the force along it by torque and
  /// force of the reaction. Used only for the tangent of the step's iteration.
  /// @param regime which of its tangents applies, as append_tangent_in_regime() says
  virtual void append_slopes(const Sight& sight, int regime,
                             std::vector<spatial::Wrench>& slopes) const = 0;

  /// The most that it holds at rest under the reaction [N] or [N m]; zero of laws that only rub
  /// where something moves.
  virtual double most_at_rest(const Sight& /*sight*/) const { return 0.0; }
};

}  // namespace buckens::loads
