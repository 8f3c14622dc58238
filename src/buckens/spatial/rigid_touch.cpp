// SPDX-License-Identifier: Apache-2.0
#include "buckens/spatial/rigid_touch.h"

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

void RigidTouch::look_at_plane(const MarkerMotion& F, const MarkerMotion& M,
                               TouchPlace& out) const {
  const Vector3d lever = M.R * data_.at;
  const Vector3d x = M.p + lever;
  const Vector3d x_rate = M.v + M.w.cross(lever);
  out.normal = F.R * data_.axis;
  out.normal_rate = F.w.cross(out.normal);
  out.gap = out.normal.dot(x - F.p) - data_.radius;
  out.place = x - data_.radius * out.normal;
  out.place_rate = x_rate - data_.radius * out.normal_rate;
}

void RigidTouch::look_at_sphere(const MarkerMotion& F, const MarkerMotion& M,
                                TouchPlace& out) const {
  const Vector3d r = M.p - F.p;
  const Vector3d r_rate = M.v - F.v;
  const double length = r.norm();
  const bool is_socket = data_.surface == Surface::socket;
  const double sign = is_socket ? -1.0 : 1.0;
  const Vector3d e = length > 0.0 ? Vector3d(r / length) : Vector3d(F.R * (sign * data_.axis));
  const Vector3d e_rate =
      length > 0.0 ? Vector3d((r_rate - e * e.dot(r_rate)) / length) : Vector3d::Zero();
  out.normal = sign * e;
  out.normal_rate = sign * e_rate;
  out.gap = is_socket ? data_.first_radius - data_.radius - length
                      : length - data_.first_radius - data_.radius;
  // The surface of M that looks at F is at length ∓ radius along e.
  const double reach = 0.5 * (data_.first_radius + length - sign * data_.radius);
  out.place = F.p + reach * e;
  out.place_rate = F.v + reach * e_rate + (0.5 * e.dot(r_rate)) * e;
}

TouchPlace RigidTouch::look(const MarkerMotion& F, const MarkerMotion& M) const {
  TouchPlace out;
  if (data_.surface == Surface::plane) {
    look_at_plane(F, M, out);
  } else {
    look_at_sphere(F, M, out);
  }
  if (data_.out_of_plane) {
    const Vector3d across = F.R * *data_.out_of_plane;
    out.along = {across.cross(out.normal).normalized(), across};
    return out;
  }
  const Vector3d pole = F.R * data_.axis;
  const Vector3d x = F.R * data_.axis.unitOrthogonal();
  out.along = {x, pole.cross(x)};
  const double open = 1.0 + pole.dot(out.normal);
  if (open < kOpposite) {
    out.along[1] = -out.along[1];
    return out;
  }
  for (Vector3d& u : out.along) u -= (out.normal.dot(u) / open) * (pole + out.normal);
  return out;
}

}  // namespace buckens::spatial
