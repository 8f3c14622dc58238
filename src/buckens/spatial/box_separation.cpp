// SPDX-License-Identifier: Apache-2.0
#include "buckens/spatial/box_separation.h"

#include <algorithm>
#include <cmath>

namespace buckens::spatial {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

// By this share of the smaller box a face of the second, or a pair of edges, has to be better.
constexpr double kClearlyApart = 1e-3;
// Square of the sine between edges that have no direction across both.
constexpr double kAlongEachOther = 1e-6;

/// Half the extent of a box along a direction.
double reach(const TouchSurface& box, const Matrix3d& axes, const Vector3d& direction) {
  const Vector3d along = (axes.transpose() * direction).cwiseAbs();
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) sum += k == box.flat ? 0.0 : box.half[k] * along[k];
  return sum;
}

double least_half(const TouchSurface& box) {
  double out = HUGE_VAL;
  for (int k = 0; k < 3; ++k) out = k == box.flat ? out : std::min(out, box.half[k]);
  return out;
}

/// @param to_other from the middle of the owner, @param sign of the normal along it
BoxSeparation by_faces(const TouchSurface& owner, const Matrix3d& axes, const TouchSurface& other,
                       const Matrix3d& other_axes, const Vector3d& to_other, double sign) {
  BoxSeparation out;
  for (int k = 0; k < 3; ++k) {
    if (k == owner.flat) continue;
    const Vector3d direction = axes.col(k);
    const double along = direction.dot(to_other);
    const double gap = std::abs(along) - owner.half[k] - reach(other, other_axes, direction);
    if (gap <= out.gap) continue;
    out.gap = gap;
    out.axis = k;
    out.normal = (along < 0.0 ? -sign : sign) * direction;
  }
  return out;
}

BoxSeparation by_edges(const TouchSurface& first, const Matrix3d& A, const TouchSurface& second,
                       const Matrix3d& B, const Vector3d& r) {
  BoxSeparation out;
  if (first.flat >= 0) return out;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      Vector3d direction = A.col(i).cross(B.col(j));
      if (direction.squaredNorm() < kAlongEachOther) continue;
      direction.normalize();
      if (direction.dot(r) < 0.0) direction = -direction;
      const double gap =
          direction.dot(r) - reach(first, A, direction) - reach(second, B, direction);
      if (gap > out.gap) out = {gap, direction, BoxSeparation::Feature::edges, i, j};
    }
  }
  return out;
}

}  // namespace

BoxSeparation BoxSeparation::of(const TouchSurface& first, const Matrix3d& A,
                                const TouchSurface& second, const Matrix3d& B, const Vector3d& r) {
  const double enough = kClearlyApart * std::min(least_half(first), least_half(second));
  BoxSeparation best = by_faces(first, A, second, B, r, 1.0);
  BoxSeparation other = by_faces(second, B, first, A, -r, -1.0);
  if (other.gap > best.gap + enough) {
    other.feature = Feature::second_face;
    best = other;
  }
  const BoxSeparation crossing = by_edges(first, A, second, B, r);
  return crossing.gap > best.gap + enough ? crossing : best;
}

}  // namespace buckens::spatial
