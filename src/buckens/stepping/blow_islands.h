// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "buckens/model/model.h"

namespace buckens::stepping {

/// Bodies that blows at the same instant reach through joints and through what touches: each
/// island has a blow of its own, at an instant of its own. The ground passes nothing on.
class BlowIslands {
 public:
  /// Bodies that joints connect are one island from the start.
  explicit BlowIslands(const model::Model& model);

  /// Forgets what touched.
  void start() { leaders_ = joined_; }
  /// @param first,second bodies, or the ground
  void unite(int first, int second);
  /// The body that stands for the island of one of two bodies, of which one may be the ground.
  std::size_t of(int first, int second) const;
  std::size_t of(std::size_t body) const;

 private:
  std::vector<std::size_t> joined_, leaders_;
};

}  // namespace buckens::stepping
