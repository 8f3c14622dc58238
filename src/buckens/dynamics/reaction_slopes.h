// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/circumstances.h"
#include "buckens/dynamics/system_kinematics.h"
#include "buckens/loads/contact_friction.h"
#include "buckens/loads/reaction_follower.h"

namespace buckens::dynamics {

/// Derivative of the force of a soft row by a multiplier of a joint, or by the force of a rigid
/// row.
struct ReactionSlope {
  int soft = 0;      ///< among the soft rows, see evaluate_soft_rows()
  int row = -1;      ///< of λ; −1: of none
  int rigid = -1;    ///< the rigid one among the soft rows; −1: of none
  double value = 0;  ///< [-], [m] or [1/m]
};

/// How forces of friction grow with the multipliers of their joints, or with the forces across
/// their rigid contacts.
class ReactionSlopes {
 public:
  /// @param model must outlive this object
  explicit ReactionSlopes(const model::Model& model);

  /// Appends those of a load, if it has any. @param soft its first soft row, @param regime of them
  /// @param sight as the law sees it, @param travel of a law on a slider's coordinate
  void append(std::size_t load, int soft, int regime, const loads::Sight& sight,
              const Circumstances& around, const Travel* travel,
              std::vector<ReactionSlope>& out) const;

 private:
  const model::Model& model_;
  std::vector<const loads::ReactionFollower*> followers_;  // by load, null: it does not follow
  std::vector<const loads::ContactFriction*> rubbing_;     // along one direction of a rigid contact
};

}  // namespace buckens::dynamics
