// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "buckens/spatial/capsule_touch.h"
#include "buckens/spatial/place_along_axis.h"
#include "buckens/spatial/segment_pair.h"

namespace buckens::spatial {

using Eigen::Vector3d;

namespace {

// Looks along the axis on one side before the nearest place is refined.
constexpr std::size_t kLooks = 12;

/// Distance of the points of a segment from a ring, in its axes; x = r + s b.
struct RingDistance {
  TouchSurface ring;
  Vector3d r, b;

  double at(double s) const { return ring.look(r + s * b, false).distance; }
  double slope(double s) const { return ring.look(r + s * b, false).normal.dot(b); }

  /// The nearest place on one side of the middle; where the distance only grows there, the end. An
  /// axis that runs rather along the cylinder's than across it has one nearest place for both.
  double nearest(double towards) const {
    const Vector3d across = b - ring.axis.dot(b) * ring.axis;
    const double size = across.squaredNorm();
    if (size < 0.5 * b.squaredNorm()) return nearest_between(-1.0, 1.0);
    const double middle = std::clamp(-across.dot(r) / size, -1.0, 1.0);
    return nearest_between(middle, towards);
  }

 private:
  /// @param from where the distance may be largest, @param to the end that stands where nothing is
  /// nearest in between
  double nearest_between(double from, double to) const {
    std::array<double, kLooks + 1> s, d;
    std::size_t best = 0;
    for (std::size_t k = 0; k < s.size(); ++k) {
      s[k] = from + static_cast<double>(k) / kLooks * (to - from);
      d[k] = at(s[k]);
      best = d[k] < d[best] ? k : best;
    }
    const double way = to - from;
    if (best == kLooks && way * slope(to) <= 0.0) return to;
    if (best == 0 && way * slope(from) >= 0.0) {
      return std::abs(from) == 1.0 || slope(from) == 0.0 ? from : to;
    }
    const double before = s[best > 0 ? best - 1 : 0], after = s[std::min(best + 1, kLooks)];
    return least_along([this](double at) { return ring.look(r + at * b); }, b,
                       std::min(before, after), s[best], std::max(before, after));
  }
};

class CapsuleOverRim final : public TouchFinder {
 public:
  CapsuleOverRim(const TouchSurface& cylinder, const TouchSurface& capsule, double end,
                 double towards)
      : ring_(cylinder), capsule_(capsule), towards_(towards) {
    ring_.kind = TouchSurface::Kind::ring;
    ring_.axis *= end;
  }

  void look(const MarkerMotion& F, const MarkerMotion& M, TouchPlace& out) const override {
    look_at(distance(F, M).nearest(towards_), F, M, out);
  }
  /// The nearer one of both sides.
  void look_at_nearest(const MarkerMotion& F, const MarkerMotion& M, TouchPlace& out) const {
    const RingDistance from = distance(F, M);
    const double one = from.nearest(1.0), other = from.nearest(-1.0);
    look_at(from.at(other) < from.at(one) ? other : one, F, M, out);
  }

 private:
  RingDistance distance(const MarkerMotion& F, const MarkerMotion& M) const {
    return {ring_, F.R.transpose() * (M.p - F.p),
            F.R.transpose() * (M.R * (capsule_.half_length * capsule_.axis))};
  }
  void look_at(double s, const MarkerMotion& F, const MarkerMotion& M, TouchPlace& out) const {
    const Vector3d r = F.R.transpose() * (M.p - F.p);
    const Vector3d half = M.R * (capsule_.half_length * capsule_.axis);
    const TouchSurface::View view = ring_.look(r + s * (F.R.transpose() * half));
    set_on_axis(view, F, capsule_, M, s, std::abs(s) < 1.0, out);
  }

  TouchSurface ring_, capsule_;
  double towards_;
};

class CapsuleAcrossCylinder final : public TouchFinder {
 public:
  CapsuleAcrossCylinder(const TouchSurface& cylinder, const TouchSurface& capsule)
      : cylinder_(cylinder),
        capsule_(capsule),
        rims_{{{cylinder, capsule, 1.0, 1.0}, {cylinder, capsule, -1.0, 1.0}}} {}

  void look(const MarkerMotion& F, const MarkerMotion& M, TouchPlace& out) const override {
    const Vector3d own = capsule_.half_length * capsule_.axis;
    const Vector3d own_axis = cylinder_.half_length * cylinder_.axis;
    const Vector3d a = F.R * own_axis, b = M.R * own;
    const auto at = NearestOfSegments::of(M.p - F.p, a, b);
    if (!at.first_is_free) return rims_[at.on_first < 0.0 ? 1 : 0].look_at_nearest(F, M, out);
    set_segments({Vector3d::Zero(), own_axis, cylinder_.radius}, F,
                 {Vector3d::Zero(), own, capsule_.radius}, M, F.R * cylinder_.axis.unitOrthogonal(),
                 out);
  }

 private:
  TouchSurface cylinder_, capsule_;
  std::array<CapsuleOverRim, 2> rims_;
};

}  // namespace

std::shared_ptr<const TouchFinder> capsule_over_rim(const TouchSurface& cylinder,
                                                    const TouchSurface& capsule, double end,
                                                    double towards) {
  return std::make_shared<CapsuleOverRim>(cylinder, capsule, end, towards);
}

std::shared_ptr<const TouchFinder> capsule_across_cylinder(const TouchSurface& cylinder,
                                                           const TouchSurface& capsule) {
  return std::make_shared<CapsuleAcrossCylinder>(cylinder, capsule);
}

}  // namespace buckens::spatial
