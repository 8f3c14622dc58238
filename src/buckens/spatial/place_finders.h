// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "buckens/spatial/rim_touch.h"
#include "buckens/spatial/whole_overlap.h"

namespace buckens::spatial {

// Share of a size by which what does not touch is apart.
inline constexpr double kNoContact = 1e-3;
// Gap down to which nothing is asked of a place, as a share of the smaller body.
inline constexpr double kTouchingPoint = 1e-9;

/// Four points of both ends: those of one end, and opposite to each the one of the other.
std::array<std::array<Eigen::Vector3d, 2>, 4> points_on_ends(const TouchSurface& cylinder);

/// A place told by a function of the motion of both bodies, where these touch across its normal.
template <class Look>
class FoundBy final : public TouchFinder {
 public:
  FoundBy(const TouchSurface& first, const TouchSurface& second, Look look)
      : first_(first),
        second_(second),
        size_(std::min(least_extent(first), least_extent(second))),
        look_(std::move(look)) {}
  void look(const MarkerMotion& F, const MarkerMotion& M, TouchPlace& out) const override {
    look_(F, M, out);
    if (out.gap > kTouchingPoint * size_) return;
    if (overlap_needlessly(first_, F, second_, M, out.normal, out.gap)) {
      out.gap = std::abs(out.gap) + kNoContact * size_;
    }
  }

 private:
  TouchSurface first_, second_;
  double size_;
  Look look_;
};

/// The place of two with the smaller gap. @param at what finds the place with a number, 0 or 1
template <class At>
void set_nearer(At at, TouchPlace& out) {
  TouchPlace other;
  at(0, out);
  at(1, other);
  if (other.gap < out.gap) out = other;
}

/// The same with the bodies exchanged.
template <class Look>
auto turned(Look look) {
  return [look = std::move(look)](const MarkerMotion& F, const MarkerMotion& M, TouchPlace& out) {
    look(M, F, out);
    turn_round(out);
  };
}

/// The nearer one of two points of M at a surface of F.
inline auto nearer_point(const TouchSurface& surface, const std::array<Eigen::Vector3d, 2>& at) {
  return [surface, at](const MarkerMotion& F, const MarkerMotion& M, TouchPlace& out) {
    set_nearer(
        [&](std::size_t k, TouchPlace& place) {
          const MovingPoint point = MovingPoint::of(M, at[k]);
          set_sphere_at(surface, F, point, 0.0, place);
          place.place = point.x;
          place.place_rate = point.rate;
        },
        out);
  };
}

}  // namespace buckens::spatial
