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

  /// Whether no force of the model looks at a reaction.
  bool empty() const { return followers_.empty() && rubbing_.empty(); }
  /// The slopes at one instant, in the order of the soft rows.
  void evaluate(const std::vector<BodyMotion>& motions, double t, const Circumstances& around,
                std::vector<ReactionSlope>& out) const;

 private:
  struct Follower {
    std::size_t load;
    int soft;  // its first soft row
    const loads::ReactionFollower* law;
  };
  /// Friction along one direction of a rigid contact.
  struct Rubbing {
    std::size_t load;
    int soft;
    const loads::ContactFriction* law;
  };
  const model::Model& model_;
  std::vector<Follower> followers_;
  std::vector<Rubbing> rubbing_;
};

}  // namespace buckens::dynamics
