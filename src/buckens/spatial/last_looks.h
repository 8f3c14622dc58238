// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "buckens/spatial/rigid_touch.h"

namespace buckens::spatial {

/// What touches were last found like, each for the motions at which it was looked at: three rows of
/// a place ask for it several times at each instant.
///
/// One per thread. Touches whose numbers fall on the same slot drive each other out.
class LastLooks {
 public:
  static LastLooks& of_this_thread();

  /// @param touch its number
  /// @param look finds the place anew
  template <class Look>
  const TouchPlace& find(std::uint64_t touch, const MarkerMotion& F, const MarkerMotion& M,
                         Look&& look) {
    Slot& slot = slots_[touch % kSlots];
    if (slot.touch != touch || !are_the_same(slot.F, F) || !are_the_same(slot.M, M)) {
      slot.touch = 0;  // should the look fail
      look(slot.place);
      slot.touch = touch;
      slot.F = F;
      slot.M = M;
    }
    return slot.place;
  }

 private:
  static constexpr std::size_t kSlots = 512;
  struct Slot {
    std::uint64_t touch = 0;  // none
    MarkerMotion F, M;
    TouchPlace place;
  };
  static bool are_the_same(const MarkerMotion& a, const MarkerMotion& b) {
    return a.p == b.p && a.v == b.v && a.w == b.w && a.R == b.R;
  }

  std::vector<Slot> slots_ = std::vector<Slot>(kSlots);
};

}  // namespace buckens::spatial
