// SPDX-License-Identifier: Apache-2.0
#include "buckens/loads/cable_span.h"

#include <cmath>

#include <Eigen/Geometry>

namespace buckens::loads {

using Eigen::Vector3d;

CableSpan CableSpan::between(const spatial::MarkerMotion& from, double from_radius,
                             const spatial::MarkerMotion& to, double to_radius,
                             const Vector3d& axis) {
  CableSpan out;
  const Vector3d apart = to.p - from.p;
  const double z = axis.dot(apart);
  const Vector3d flat = apart - z * axis;
  const double D = flat.norm(), q = to_radius - from_radius;
  out.centres = D;
  if (!(D > std::abs(q))) return out;
  const double L = std::sqrt(D * D - q * q);
  out.length = std::hypot(L, z);
  const Vector3d e = flat / D, across = axis.cross(e);
  // D e = L along + q left.
  out.along = (L * e - q * across) / D;
  out.left = (L * across + q * e) / D;
  out.lengthens = (D * e + z * axis) / out.length;
  out.turns = across / D + q / (D * L) * e;
  // Rims that turn forwards, and spans that turn about them, take in and give out cable.
  const Vector3d pulls = out.lengthens - q * out.turns;
  out.on_to << (to_radius * axis).transpose(), pulls.transpose();
  out.on_from << (-from_radius * axis).transpose(), -pulls.transpose();
  return out;
}

}  // namespace buckens::loads
