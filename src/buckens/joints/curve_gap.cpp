// SPDX-License-Identifier: Apache-2.0
#include "buckens/joints/curve_gap.h"

#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "buckens/base/errors.h"
#include "buckens/joints/relative_turn.h"

namespace buckens::joints {

using Eigen::Vector3d;
using spatial::MarkerBias;
using spatial::MarkerMotion;

namespace {
constexpr int kLooks = 500;
constexpr double kAlong = 1e-3;  // sine between a curve and its normal
}  // namespace

spatial::PairRow CurveTouch::derivatives(const MarkerMotion& F, const MarkerMotion& M) const {
  const Vector3d n_W = F.R * n;
  spatial::PairRow J = spatial::PairRow::Zero();
  J.segment<3>(0) = -(M.p - F.p).cross(n_W).transpose();
  J.segment<3>(3) = -n_W.transpose();
  J.segment<3>(9) = n_W.transpose();
  return J;
}

double CurveTouch::bias(const MarkerMotion& F, const MarkerMotion& M, const MarkerBias& bias_F,
                        const MarkerBias& bias_M, const Vector3d& across) const {
  const Vector3d rate = M.v - F.v - F.w.cross(M.p - F.p);
  // Along the curve, seen from above a plane one.
  const Vector3d tangent = at.tangent - across.dot(at.tangent) * across;
  const double square = tangent.squaredNorm();
  const double curvature = n.dot(at.curvature) / square;
  const double along = (F.R * tangent).dot(rate) / std::sqrt(square);
  return (F.R * n).dot(relative_bias(F, M, bias_F, bias_M)) -
         curvature * along * along / (1.0 - curvature * gap());
}

Vector3d unit_normal(const SpaceCurve& curve, const Vector3d& normal) {
  if (!(normal.norm() > 0.0)) {
    throw ModelError("`normal` has no direction; give three numbers, not all zero");
  }
  const Vector3d across = normal.normalized();
  for (int k = 0; k <= kLooks; ++k) {
    const Vector3d t = curve.at(curve.length() * k / kLooks).tangent.normalized();
    if (t.cross(across).norm() > kAlong) continue;
    throw ModelError(
        "`path` runs along its `normal`; give the direction across the plane of the curve");
  }
  return across;
}

CurveGap::CurveGap(std::shared_ptr<const SpaceCurve> curve, const Data& data)
    : curve_(std::move(curve)),
      across_(unit_normal(*curve_, data.normal_F)),
      side_(data.is_on_left ? 1.0 : -1.0),
      radius_(data.radius) {}

bool CurveGap::is_rim() const {
  return curve_->is_closed() && (side_ > 0.0) != encloses_left(*curve_, across_);
}

bool CurveGap::encloses_left(const SpaceCurve& curve, const Vector3d& normal_F) {
  Vector3d area = Vector3d::Zero();
  const Vector3d first = curve.at(0.0).p;
  for (int k = 1; k + 1 < kLooks; ++k) {
    const Vector3d a = curve.at(curve.length() * k / kLooks).p - first;
    const Vector3d b = curve.at(curve.length() * (k + 1) / kLooks).p - first;
    area += a.cross(b);
  }
  return area.dot(normal_F) > 0.0;
}

CurveTouch CurveGap::touch(const MarkerMotion& F, const MarkerMotion& M) const {
  CurveTouch out;
  out.place = F.R.transpose() * (M.p - F.p);
  out.s = curve_->nearest(out.place, across_);
  out.at = curve_->at(out.s);
  out.n = side_ * across_.cross(out.at.tangent).normalized();
  return out;
}

double CurveGap::gap(const MarkerMotion& F, const MarkerMotion& M) const {
  return touch(F, M).gap() - radius_;
}

spatial::PairRow CurveGap::derivatives(const MarkerMotion& F, const MarkerMotion& M) const {
  return touch(F, M).derivatives(F, M);
}

double CurveGap::bias(const MarkerMotion& F, const MarkerMotion& M, const MarkerBias& bias_F,
                      const MarkerBias& bias_M) const {
  return touch(F, M).bias(F, M, bias_F, bias_M, across_);
}

}  // namespace buckens::joints
