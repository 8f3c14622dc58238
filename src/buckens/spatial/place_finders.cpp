// SPDX-License-Identifier: Apache-2.0
#include "buckens/spatial/place_finders.h"

namespace buckens::spatial {

using Eigen::Vector3d;

namespace {

// Share of the radius at which points lie that stay on an end, so that what rolls does not touch
// with them.
constexpr double kInsideEnd = 0.9999;

}  // namespace

std::array<std::array<Vector3d, 2>, 4> points_on_ends(const TouchSurface& cylinder) {
  const Vector3d u = M_SQRT1_2 * kInsideEnd * cylinder.radius * cylinder.axis.unitOrthogonal();
  const Vector3d w = cylinder.axis.cross(u), up = cylinder.half_length * cylinder.axis;
  std::array<std::array<Vector3d, 2>, 4> out;
  std::size_t next = 0;
  for (const Vector3d& at : {Vector3d(u + w), Vector3d(u - w), Vector3d(-u - w), Vector3d(w - u)}) {
    out[next++] = {at + up, at - up};
  }
  return out;
}

}  // namespace buckens::spatial
