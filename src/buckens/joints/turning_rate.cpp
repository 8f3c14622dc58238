// SPDX-License-Identifier: Apache-2.0
#include "buckens/joints/turning_rate.h"

namespace buckens::joints {

using Eigen::Vector3d;

CoordinateLook TurningRate::look(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
                                 const CountedValue* /*before*/) const {
  const Vector3d a = F.R * axis_F_;
  CoordinateLook out;
  out.J.segment<3>(0) = -a.transpose();
  out.J.segment<3>(6) = a.transpose();
  out.rate = a.dot(M.w - F.w);
  return out;
}

double TurningRate::bias(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
                         const spatial::MarkerBias& bias_F, const spatial::MarkerBias& bias_M,
                         const CountedValue* /*before*/) const {
  const Vector3d a = F.R * axis_F_;
  return a.dot(bias_M.alpha - bias_F.alpha) + F.w.cross(a).dot(M.w - F.w);
}

}  // namespace buckens::joints
