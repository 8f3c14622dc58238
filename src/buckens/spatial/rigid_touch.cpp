// SPDX-License-Identifier: Apache-2.0
#include "buckens/spatial/rigid_touch.h"

#include <atomic>

#include "buckens/spatial/last_looks.h"
#include "buckens/spatial/rim_touch.h"

namespace buckens::spatial {

using Eigen::Vector3d;

namespace {

// Where the normal is opposite to the one as placed, by this much, its way there is not unique.
constexpr double kOpposite = 1e-12;

}  // namespace

PairRow TouchPlace::row(const Vector3d& direction, const MarkerMotion& F,
                        const MarkerMotion& M) const {
  PairRow J;
  J.segment<3>(0) = -(place - F.p).cross(direction).transpose();
  J.segment<3>(3) = -direction.transpose();
  J.segment<3>(6) = (place - M.p).cross(direction).transpose();
  J.segment<3>(9) = direction.transpose();
  return J;
}

Vector3d TouchPlace::velocity(const MarkerMotion& F, const MarkerMotion& M) const {
  return M.v + M.w.cross(place - M.p) - F.v - F.w.cross(place - F.p);
}

void RigidTouch::look_at_rim(const MarkerMotion& F, const MarkerMotion& M, TouchPlace& out) const {
  out.normal = F.R * data_.surface.axis;
  out.normal_rate = F.w.cross(out.normal);
  const MovingPoint lowest =
      lowest_of_rim({data_.at, data_.axis, data_.radius}, M, out.normal, out.normal_rate);
  out.place = lowest.x;
  out.place_rate = lowest.rate;
  out.gap = out.normal.dot(out.place - F.p);
}

RigidTouch::RigidTouch(const Data& data) : data_(data) {
  static std::atomic<std::uint64_t> last = 0;
  number_ = ++last;
}

TouchPlace RigidTouch::look(const MarkerMotion& F, const MarkerMotion& M) const {
  return LastLooks::of_this_thread().find(number_, F, M,
                                          [&](TouchPlace& out) { look_anew(F, M, out); });
}

void RigidTouch::look_anew(const MarkerMotion& F, const MarkerMotion& M, TouchPlace& out) const {
  out = {};
  switch (data_.feature) {
    case Feature::point_of_second:
      set_sphere_at(data_.surface, F, MovingPoint::of(M, data_.at), data_.radius, out);
      break;
    case Feature::point_of_first:
      set_sphere_at(data_.surface, M, MovingPoint::of(F, data_.at), data_.radius, out);
      turn_round(out);
      break;
    case Feature::rim:
      look_at_rim(F, M, out);
      break;
    case Feature::axes:
      set_segments(
          {Vector3d::Zero(), data_.surface.half_length * data_.surface.axis, data_.surface.radius},
          F, {Vector3d::Zero(), data_.half_length * data_.axis, data_.radius}, M, F.R * data_.pole,
          out);
      break;
    case Feature::found:
      data_.finder->look(F, M, out);
      break;
  }
  set_directions(F, out);
}

void RigidTouch::set_directions(const MarkerMotion& F, TouchPlace& out) const {
  if (data_.out_of_plane) {
    const Vector3d across = F.R * *data_.out_of_plane;
    out.along = {across.cross(out.normal).normalized(), across};
    return;
  }
  const Vector3d pole = F.R * data_.pole;
  const Vector3d x = F.R * data_.pole.unitOrthogonal();
  out.along = {x, pole.cross(x)};
  const double open = 1.0 + pole.dot(out.normal);
  if (open < kOpposite) {
    out.along[1] = -out.along[1];
    return;
  }
  for (Vector3d& u : out.along) u -= (out.normal.dot(u) / open) * (pole + out.normal);
}

}  // namespace buckens::spatial
