// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/model/model.h"

namespace buckens::stepping {

/// Islands of bodies that impacts in the same step reach through joints and contacts. Each island
/// has its own strongest impact, at its own instant. The ground transmits nothing.
class BlowIslands {
 public:
  /// Bodies that joints connect are one island from the start.
  explicit BlowIslands(const model::Model& model);

  /// Forgets all contacts.
  void start() { leaders_ = joined_; }
  /// @param first,second bodies, or the ground
  void unite(int first, int second);
  /// The body that represents the island of two bodies, one of which may be the ground.
  std::size_t of(int first, int second) const;
  std::size_t of(std::size_t body) const;

 private:
  std::vector<std::size_t> joined_, leaders_;
};

}  // namespace buckens::stepping
