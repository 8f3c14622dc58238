// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/joint_rub.h"
#include "buckens/dynamics/law_ends.h"
#include "buckens/stepping/scheme.h"

namespace buckens::stepping {

/// Dry friction in joints as a step has used it: the forces of its last iteration, at the instant
/// where the equations of motion hold, and the rates at its end, before impacts. The account of
/// energy forms its work from them. Theory: docs/theory/23-impacts.md §5.
class FrictionOfStep {
 public:
  FrictionOfStep(const model::Model& model, const Scheme& scheme)
      : model_(model),
        scheme_(scheme),
        loads_(dynamics::rubbing_joints(model)),
        rubs_(loads_.size()) {}

  /// Motions of one instant.
  struct Instant {
    double t;
    const std::vector<dynamics::BodyMotion>& motions;
  };
  /// @param evaluated where the equations hold, @param around as in the last iteration
  /// @param ends null, or what is known of laws where both instants are the same
  void take(const Instant& evaluated, const Instant& end, const dynamics::Circumstances& around,
            const dynamics::LawEnds* ends);

  bool empty() const { return loads_.empty(); }
  const Scheme& scheme() const { return scheme_; }
  /// Indices into Model::loads, ascending.
  const std::vector<std::size_t>& loads() const { return loads_; }
  /// One for each.
  const std::vector<dynamics::JointRub>& rubs() const { return rubs_; }

 private:
  const model::Model& model_;
  Scheme scheme_;
  std::vector<std::size_t> loads_;
  std::vector<dynamics::JointRub> rubs_;
};

}  // namespace buckens::stepping
