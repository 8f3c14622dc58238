// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/model/model.h"

namespace buckens::model {

/// What holds a shaft: a joint that lets it turn about `Joint::axis_F`, and the body on which it
/// is.
struct Bearing {
  const Joint* joint = nullptr;
  int on = kGround;
};

/// Two shafts that a universal joint connects, and their bearings.
struct ShaftPair {
  const Joint* cross = nullptr;
  Bearing first, second;
  /// Whether one body carries both bearings; the parts of a divided body are one.
  bool has_common_carrier = false;
};

/// Pairs of shafts whose bearings are on one body, or on two bodies that a joint holds together and
/// perhaps lets swing against each other. Of others the relative motion is free, so that nothing
/// has to pass from shaft to shaft. @param model outlives the pairs
std::vector<ShaftPair> shaft_pairs(const Model& model);

}  // namespace buckens::model
