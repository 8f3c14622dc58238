// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/model/model.h"

namespace buckens::dynamics {

/// What laws on joints and their coordinates remember if a step ends where they were evaluated, so
/// that its end need not evaluate them again.
struct LawEnds {
  struct Coordinate {
    bool is_known = false;
    joints::CountedValue value;
  };
  struct Law {
    bool is_known = false;
    double state = 0;  ///< the only one that it has
    double force = 0;  ///< along its coordinate [N] or [N m]
  };
  std::vector<Coordinate> coordinates;  ///< one per Model::coordinates
  std::vector<Law> laws;                ///< one per Model::loads

  /// Knows nothing any more.
  void forget(const model::Model& model) {
    coordinates.resize(model.coordinates.size());
    laws.resize(model.loads.size());
    for (Coordinate& coordinate : coordinates) coordinate.is_known = false;
    for (Law& law : laws) law.is_known = false;
  }
  bool knows_coordinate(std::size_t k) const {
    return k < coordinates.size() && coordinates[k].is_known;
  }
  bool knows_law(std::size_t load) const { return load < laws.size() && laws[load].is_known; }
};

}  // namespace buckens::dynamics
