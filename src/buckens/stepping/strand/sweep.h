// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "buckens/stepping/strand/layout.h"

namespace buckens::stepping::strand {

/// Goes through the blocks of joints and of bodies by turns, in each turn through all of them and
/// in their order, but not through one turn after the other: a block has its turn as soon as all
/// those before it, and all that hold it or are held by it, have had the turn before. So along a
/// chain of any length all turns work on what is in the cache.
class Sweep {
 public:
  Sweep() = default;
  Sweep(const std::vector<BodyBlock>& bodies, const std::vector<JointBlock>& joints);

  /// @param turns functions of the index of a block: of joints, then of bodies, and so on
  template <class... Turns>
  void joints_first(Turns&&... turns) const {
    run(last_joint_, last_body_, std::forward<Turns>(turns)...);
  }
  /// The same, beginning with bodies.
  template <class... Turns>
  void bodies_first(Turns&&... turns) const {
    run(last_body_, last_joint_, std::forward<Turns>(turns)...);
  }

 private:
  /// @param before per block of the second turn the number of blocks of the first that it needs
  template <class First, class... Rest>
  static void run(const std::vector<std::size_t>& before, const std::vector<std::size_t>& behind,
                  First&& first, Rest&&... rest) {
    constexpr std::size_t kTurns = sizeof...(Rest) + 1;
    std::size_t done[kTurns] = {};
    for (std::size_t k = 0; k < behind.size(); ++k) {
      first(k);
      done[0] = k + 1;
      follow<1>(before, behind, done, rest...);
    }
  }
  template <std::size_t Turn>
  static void follow(const std::vector<std::size_t>&, const std::vector<std::size_t>&,
                     std::size_t*) {}
  template <std::size_t Turn, class Next, class... Rest>
  static void follow(const std::vector<std::size_t>& needs, const std::vector<std::size_t>& behind,
                     std::size_t* done, Next&& next, Rest&&... rest) {
    // After the last turn of the same block, too, which what it needs may not tell.
    const auto is_next = [&](std::size_t k) {
      if constexpr (Turn > 1) {
        if (k >= done[Turn - 2]) return false;
      }
      return k < needs.size() && needs[k] <= done[Turn - 1];
    };
    for (; is_next(done[Turn]); ++done[Turn]) next(done[Turn]);
    follow<Turn + 1>(behind, needs, done, rest...);
  }

  // Of every block of bodies how many blocks of joints, counted from the first, contain all that
  // hold it or one before it; and of every block of joints the same of bodies.
  std::vector<std::size_t> last_joint_, last_body_;
};

}  // namespace buckens::stepping::strand
