// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "buckens/spatial/cylinder_touch.h"
#include "buckens/spatial/place_finders.h"
#include "buckens/spatial/segment_pair.h"

namespace buckens::spatial {

using Eigen::Vector3d;

namespace {

using EdgePair = std::array<SharpEdge, 2>;

/// An edge of F at the side of a cylinder of M; beyond its ends, at the rim there.
void set_side_over_edge(const SharpEdge& edge, const MarkerMotion& F, const TouchSurface& cylinder,
                        const MarkerMotion& M, TouchPlace& out) {
  const Vector3d half = edge.half_length * edge.along;
  const Vector3d own = cylinder.half_length * cylinder.axis;
  const Vector3d a = F.R * half, b = M.R * own, r = M.p - F.p - F.R * edge.middle;
  const auto at = NearestOfSegments::of(r, a, b);
  const Vector3d between = r + at.on_second * b - at.on_first * a;
  const double gap = between.norm() - cylinder.radius;
  // What is further below the side than below the end is not at the side.
  if (-gap <= (1.0 - std::abs(at.on_second)) * cylinder.half_length &&
      std::abs(at.on_second) < 1.0) {
    return set_segments({edge.middle, half, 0.0}, F, {Vector3d::Zero(), own, cylinder.radius}, M,
                        F.R * edge.middle.normalized(), out);
  }
  // On one side of the two, between which rounding would choose.
  const double end = at.on_second < 0.0 ? -1.0 : 1.0;
  set_rim_over_edge(edge, F, Rim::of(cylinder, end), M, 1.0, out);
  const Vector3d axis = M.R * cylinder.axis;
  leave_to_rim(std::max(std::abs(gap), std::abs(axis.dot(between))), axis, cylinder.radius, out);
}

/// Edges that lie opposite to each other: three directions, two pairs each.
std::vector<EdgePair> opposite_edges(const TouchSurface& box) {
  std::vector<EdgePair> out;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double one : {1.0, -1.0}) {
      out.push_back({SharpEdge::of(box, axis, one, 1.0), SharpEdge::of(box, axis, -one, -1.0)});
    }
  }
  return out;
}

template <class Add>
void add_corners(const TouchSurface& box, const TouchSurface& cylinder, Add add) {
  for (const double one : {1.0, -1.0}) {
    for (const double other : {1.0, -1.0}) {
      const Vector3d corner = box.half.cwiseProduct(Vector3d(one, other, 1.0));
      add(turned(nearer_point(cylinder, {corner, Vector3d(-corner)})));
    }
  }
}

template <class Add>
void add_edges(const TouchSurface& box, const TouchSurface& cylinder, Add add) {
  for (const EdgePair& edges : opposite_edges(box)) {
    add([=](const MarkerMotion& F, const MarkerMotion& M, TouchPlace& place) {
      set_nearer([&](std::size_t k,
                     TouchPlace& own) { set_side_over_edge(edges[k], F, cylinder, M, own); },
                 place);
    });
    for (const double end : {1.0, -1.0}) {
      const Rim rim = Rim::of(cylinder, end);
      for (const double towards : {1.0, -1.0}) {
        add([=](const MarkerMotion& F, const MarkerMotion& M, TouchPlace& place) {
          set_nearer([&](std::size_t k,
                         TouchPlace& own) { set_rim_over_edge(edges[k], F, rim, M, towards, own); },
                     place);
        });
      }
    }
  }
}

}  // namespace

TouchFinders cylinder_over_box(const TouchSurface& box, const TouchSurface& cylinder) {
  TouchFinders out;
  const auto add = [&]<class Look>(Look look) {
    out.push_back(std::make_shared<FoundBy<Look>>(box, cylinder, std::move(look)));
  };
  for (const double end : {1.0, -1.0}) {
    const Rim rim = Rim::of(cylinder, end);
    for (int axis = 0; axis < 3; ++axis) {
      add([=](const MarkerMotion& F, const MarkerMotion& M, TouchPlace& place) {
        set_rim_over_face(box, axis, F, rim, M, place);
      });
    }
  }
  for (const auto& points : points_on_ends(cylinder)) add(nearer_point(box, points));
  add_corners(box, cylinder, add);
  add_edges(box, cylinder, add);
  return out;
}

}  // namespace buckens::spatial
