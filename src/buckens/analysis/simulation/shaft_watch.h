// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/dynamics/system_kinematics.h"
#include "buckens/model/shaft_pairs.h"

namespace buckens::analysis {

/// Watches the angle between shafts that universal joints connect and whose bearings move against
/// each other.
///
/// At 90 degrees the cross passes on no rotation, and where the motion goes on from there is not
/// determined: at other angles of the shafts it would go on another way. Cost: a few markers per
/// such joint and step; nothing where there are none.
class ShaftWatch {
 public:
  /// @param model outlives the watch
  explicit ShaftWatch(const model::Model& model);

  /// @throws NumericalError with joint, bearings, instant and remedy if shafts have come to stand
  ///         across each other between two states
  void check(const model::State& before, const model::State& after);
  /// The same for a step that failed: blames shafts that stand within 5 degrees of it.
  void check_failed(const model::State& before);

 private:
  double cosine(const model::ShaftPair& pair, const model::State& state);
  void follow(int body, const model::State& state);

  const model::Model& model_;
  std::vector<model::ShaftPair> pairs_;
  std::vector<dynamics::BodyMotion> motions_;
};

}  // namespace buckens::analysis
