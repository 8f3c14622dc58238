// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "buckens/joints/gap_law.h"
#include "buckens/joints/space_curve.h"
#include "buckens/spatial/marker_motion.h"

namespace buckens::joints {

/// Where a place is nearest to a curve, all in F.
struct CurveTouch {
  double s = 0;
  CurvePoint at;
  Eigen::Vector3d place;  ///< of M
  Eigen::Vector3d n;      ///< unit vector across the curve

  double gap() const { return n.dot(place - at.p); }
  /// Derivatives of n·(ρ − c(s)) by both twists: changes of s do not change it.
  spatial::PairRow derivatives(const spatial::MarkerMotion& F,
                               const spatial::MarkerMotion& M) const;
  /// Part of its second derivative without accelerations of the bodies' coordinates.
  /// @param across direction out of which distances are not counted, or zero
  double bias(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
              const spatial::MarkerBias& bias_F, const spatial::MarkerBias& bias_M,
              const Eigen::Vector3d& across) const;
};

/// The gap between a roller at M and a plane curve fixed in F, along the plane:
///
///     g = ± n(s)·(ρ − c(s)) − r,   c′(s)·(ρ − c(s)) = 0,   n = a × c′/|c′|                  (R34)
///
/// with a the normal of the plane. s is that of the nearest point of the whole curve: a roller that
/// has lost contact finds the curve again elsewhere.
class CurveGap final : public GapLaw {
 public:
  struct Data {
    Eigen::Vector3d normal_F = Eigen::Vector3d::UnitZ();  ///< a, any length
    bool is_on_left = true;  ///< the free side, seen along the curve with a upwards
    double radius = 0;       ///< r [m]
  };
  /// @throws ModelError if the normal has no direction, or the curve runs along it
  CurveGap(std::shared_ptr<const SpaceCurve> curve, const Data& data);

  /// Whether the inside of a closed curve is on its left.
  static bool encloses_left(const SpaceCurve& curve, const Eigen::Vector3d& normal_F);

  const SpaceCurve& curve() const { return *curve_; }
  /// Unit normal of its plane, in F.
  const Eigen::Vector3d& across() const { return across_; }
  /// Of the roller [m].
  double radius() const { return radius_; }
  /// Whether the roller runs outside of a closed curve, which then is the rim of a disc.
  bool is_rim() const;

  double gap(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M) const override;
  spatial::PairRow derivatives(const spatial::MarkerMotion& F,
                               const spatial::MarkerMotion& M) const override;
  double bias(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M,
              const spatial::MarkerBias& bias_F, const spatial::MarkerBias& bias_M) const override;

 private:
  CurveTouch touch(const spatial::MarkerMotion& F, const spatial::MarkerMotion& M) const;

  std::shared_ptr<const SpaceCurve> curve_;
  Eigen::Vector3d across_;
  double side_ = 1, radius_ = 0;
};

/// Unit normal of the plane of a curve.
/// @throws ModelError if it has no direction, or the curve runs along it
Eigen::Vector3d unit_normal(const SpaceCurve& curve, const Eigen::Vector3d& normal);

}  // namespace buckens::joints
