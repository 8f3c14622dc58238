// SPDX-License-Identifier: Apache-2.0
#include "buckens/spatial/whole_overlap.h"

#include <algorithm>
#include <cmath>

namespace buckens::spatial {

using Eigen::Vector3d;

namespace {

// How many times the least overlap is still no more than needed.
constexpr double kAboutLeast = 5.0;
// Cosine between directions one of which is the other, turned by an overlap or on its way there.
constexpr double kAboutSame = 0.8;
// Rounding of places, as a share of the smaller body.
constexpr double kOverlapRounding = 1e-9;
// Square of the sine between directions that have none across both.
constexpr double kSameDirection = 1e-12;

struct MovedSolid {
  const TouchSurface& solid;
  const MarkerMotion& motion;

  bool is_box() const { return solid.kind == TouchSurface::Kind::box; }
  int num_directions() const { return is_box() ? 3 : 1; }
  /// Normal to a face or an end; edges of a box, and the axis, are along these as well.
  Vector3d direction(int k) const {
    return is_box() ? Vector3d(motion.R.col(k)) : Vector3d(motion.R * solid.axis);
  }
  double reach(const Vector3d& along) const {
    const Vector3d own = motion.R.transpose() * along;
    if (is_box()) return solid.half.dot(own.cwiseAbs());
    const double axial = solid.axis.dot(own);
    return solid.half_length * std::abs(axial) + solid.radius * (own - axial * solid.axis).norm();
  }
};

}  // namespace

double least_extent(const TouchSurface& solid) {
  return solid.kind == TouchSurface::Kind::box ? solid.half.minCoeff()
                                               : std::min(solid.radius, solid.half_length);
}

bool overlap_needlessly(const TouchSurface& first, const MarkerMotion& F,
                        const TouchSurface& second, const MarkerMotion& M, const Vector3d& normal,
                        double gap) {
  const MovedSolid one{first, F}, other{second, M};
  const Vector3d r = M.p - F.p;
  const double own = one.reach(normal) + other.reach(normal) - normal.dot(r);
  const double rounding = kOverlapRounding * std::min(least_extent(first), least_extent(second));
  if (-gap > kAboutLeast * std::max(own, 0.0) + rounding) return true;
  double least = own;
  Vector3d clearest = normal;
  const auto try_direction = [&](const Vector3d& along) {
    const double overlap = one.reach(along) + other.reach(along) - std::abs(along.dot(r));
    if (overlap >= least) return;
    least = overlap;
    clearest = along;
  };
  for (int i = 0; i < one.num_directions(); ++i) try_direction(one.direction(i));
  for (int j = 0; j < other.num_directions(); ++j) try_direction(other.direction(j));
  for (int i = 0; i < one.num_directions(); ++i) {
    for (int j = 0; j < other.num_directions(); ++j) {
      const Vector3d across = one.direction(i).cross(other.direction(j));
      if (across.squaredNorm() > kSameDirection) try_direction(across.normalized());
    }
  }
  // Of two cylinders side by side, from axis to axis.
  if (!one.is_box() && !other.is_box()) {
    const Vector3d axis = one.direction(0), beside = r - axis.dot(r) * axis;
    if (beside.squaredNorm() > 0.0) try_direction(beside.normalized());
  }
  if (std::abs(clearest.dot(normal)) > kAboutSame) return false;
  return own > kAboutLeast * std::max(least, 0.0) + rounding;
}

}  // namespace buckens::spatial
