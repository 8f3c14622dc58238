// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "buckens/spatial/capsule_touch.h"
#include "buckens/spatial/touch_features.h"

namespace buckens::spatial {

using Eigen::Vector3d;

namespace {

class CapsuleOverEdge final : public TouchFinder {
 public:
  CapsuleOverEdge(RoundSegment edge, const TouchSurface& capsule)
      : edge_(std::move(edge)),
        own_{Vector3d::Zero(), capsule.half_length * capsule.axis, capsule.radius} {}

  void look(const MarkerMotion& F, const MarkerMotion& M, TouchPlace& out) const override {
    set_segments(edge_, F, own_, M, F.R * edge_.middle.normalized(), out);
  }

 private:
  RoundSegment edge_, own_;
};

/// @param along axis of the edge, @param one,other signs along the axes after it
RoundSegment edge_of(const TouchSurface& box, int along, double one, double other) {
  const int u = (along + 1) % 3, v = (along + 2) % 3;
  RoundSegment out{Vector3d::Zero(), Vector3d::Zero(), 0.0};
  out.middle[u] = one * box.half[u];
  out.middle[v] = other * box.half[v];
  if (along != box.flat) out.half[along] = box.half[along];
  return out;
}

}  // namespace

TouchFinders capsule_over_edges(const TouchSurface& box, const TouchSurface& capsule) {
  TouchFinders out;
  for (int along = 0; along < 3; ++along) {
    if (box.flat >= 0 && along != box.flat) continue;
    for (const double one : {1.0, -1.0}) {
      for (const double other : {1.0, -1.0}) {
        out.push_back(std::make_shared<CapsuleOverEdge>(edge_of(box, along, one, other), capsule));
      }
    }
  }
  return out;
}

}  // namespace buckens::spatial
